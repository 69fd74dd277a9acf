#pragma once

#include <string>

namespace anthrob {

/// What --version prints: the program's name and the suite's version.
std::string version_of(const std::string& program);

}  // namespace anthrob
