#pragma once

#include "fit/convergence.h"
#include "hypotheses/candidate_comparison.h"

namespace anthrob {
namespace discovery {

/// Limits a probability by the scatter of fits. Two fits of one law to one recording may end a
/// little apart, and the true law may differ from both by as much. A difference of that size
/// decides nothing, however many blocks agree.
/// @param by_blocks probability of one law against the other, from the blocks of the recordings
/// @param base fitted without them
/// @param one, other fitted to the end   @param least scatter, as a share of the better one's gain
/// @return the same, but no nearer to 0 or 1 than Phi(lead / scatter); this moves it at most to 0.5
double allowing_for_scatter(double by_blocks, const Convergence& convergence, const Tested& base,
                            const Tested& one, const Tested& other, double least);

}  // namespace discovery
}  // namespace anthrob
