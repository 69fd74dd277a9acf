#pragma once

#include <optional>
#include <string>

namespace anthrob {

/// What is malformed in a COLLADA file: counts and indices that are none, arrays of another length,
/// links that lead nowhere. The library that reads it hangs or dies of such files.
/// @return line, element and what was expected; none if nothing was found
std::optional<std::string> fault_of_collada(const std::string& file);

}  // namespace anthrob
