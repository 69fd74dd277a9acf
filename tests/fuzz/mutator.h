#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace anthrob {
namespace fuzz {

/// A sound file, damaged. The same number gives the same file on every machine.
/// @param sound files to begin from, at least one   @param number of the input
std::string mutated(const std::vector<std::string>& sound, std::uint64_t number);

}  // namespace fuzz
}  // namespace anthrob
