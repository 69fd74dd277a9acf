#pragma once

#include <vector>

#include "conclusion/answer.h"
#include "experiment/measured_variable.h"
#include "hypotheses/hypotheses.h"

namespace anthrob {
namespace discovery {

/// Values and intervals of all effects, by effect, in the model as it is at the end: later ones
/// have moved earlier ones (step 9 of docs/discovery_method.md).
std::vector<std::vector<FoundParameter>> measure_sizes(
    const Hypotheses& hypotheses, const std::vector<MeasuredVariable>& variables,
    const SearchResult& found, std::uint64_t seed);

}  // namespace discovery
}  // namespace anthrob
