#pragma once

#include "anthrob_config/config_node.h"
