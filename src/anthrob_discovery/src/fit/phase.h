#pragma once

#include <optional>
#include <vector>

#include "fit/candidate.h"
#include "fit/model_fit.h"

namespace anthrob {
namespace discovery {

/// Whether the candidate has two sizes of one unit that may have either sign: an amplitude and a
/// phase, as for cogging.
bool has_phase(const Candidate& candidate);

/// The same amplitude a quarter, half and three quarters of a turn further.
/// @param candidate one that has a phase   @param amount its sizes [doses], like the returned ones
std::vector<std::vector<double>> other_phases(const Candidate& candidate,
                                              const std::vector<double>& amount);

/// A fit to a periodic effect ends in the phase next to where it began, which need not be the best.
/// @param fitted its last effect is the candidate's
/// @return that effect in the best of the seven phases an eighth of a turn apart from each other
/// and the present one, all else as it is; nothing if none is better than the present one
std::optional<EffectInstance> better_phase(const ModelFit& fit, const Candidate& candidate,
                                           const Fitted& fitted);

}  // namespace discovery
}  // namespace anthrob
