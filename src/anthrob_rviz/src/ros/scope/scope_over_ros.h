#pragma once

#include <memory>

#include "scope/scope_model.h"

namespace anthrob {

/// With the topics of the ROS master, and bags and data sets of the disk.
std::unique_ptr<ScopeModel> scope_over_ros();

}  // namespace anthrob
