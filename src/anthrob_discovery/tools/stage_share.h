#pragma once

#include <cstddef>

namespace anthrob {
namespace discovery {

/// Share of all stages that is done, 0 to below 1. How many there will be depends on what is found:
/// this counts a usual number for each effect that may be named, and gets slower beyond it.
/// @param done stages   @param max_effects as of the question
double share_of_stages(std::size_t done, int max_effects);

}  // namespace discovery
}  // namespace anthrob
