#pragma once

#include <string>

#include "readers.h"

namespace anthrob {
namespace fuzz {

/// Lets a reader read all its sound files.
/// @throws what the reader throws: damaged ones would tell nothing
void give_sound(const Reader& reader);

/// Lets a reader read a damaged file.
/// @return whether it was accepted
/// @throws std::logic_error if it was refused otherwise than with one line
bool give(const Reader& reader, const std::string& input);

}  // namespace fuzz
}  // namespace anthrob
