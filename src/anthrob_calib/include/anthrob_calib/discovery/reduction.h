#pragma once

#include <optional>

#include "anthrob_calib/discovery/candidate.h"
#include "anthrob_calib/discovery/model_fit.h"

namespace anthrob {
namespace discovery {

/// The same fit without one of its effects, others and parameters where they are: nothing is fitted
/// again. An ordinary parameter that is the same quantity (Candidate::same_as) says what the effect
/// said, and is free again.
/// @param effect index among the variant's effects, of which `candidate` is the candidate
/// @return nothing if that cannot be simulated
std::optional<Fitted> without_effect(const Evaluator& evaluator, const ModelFit& fit,
                                     const Fitted& fitted, std::size_t effect,
                                     const Candidate& candidate);

/// The same fit with its last effect at another index, those from there on one further.
/// @return nothing if that cannot be simulated
std::optional<Fitted> with_last_effect_at(const ModelFit& fit, const Fitted& fitted,
                                          std::size_t index);

}  // namespace discovery
}  // namespace anthrob
