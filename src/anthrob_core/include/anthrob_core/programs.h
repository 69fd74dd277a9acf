#pragma once

#include <string>

namespace anthrob {

/// A program of a package of this suite: where the one that runs lies, or in a space whose setup
/// file was sourced.
/// @throws std::runtime_error with one line if it is not there
std::string program_of_package(const std::string& package, const std::string& name);

}  // namespace anthrob
