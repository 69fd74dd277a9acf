#pragma once

#include <string>

#include "anthrob_recording/dataset.h"

namespace anthrob {

/// "4 tables, 12000 rows, 30.000 s", for those who are told what was written.
std::string extent_of(const Dataset& data);

}  // namespace anthrob
