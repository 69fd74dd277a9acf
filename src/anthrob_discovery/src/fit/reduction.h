#pragma once

#include <optional>

#include "fit/candidate.h"
#include "fit/model_fit.h"

namespace anthrob {
namespace discovery {

/// The same fit without one of its effects; everything else stays where it is, and nothing is
/// fitted again. An ordinary parameter that is the same quantity (Candidate::same_as) takes over
/// the size of the effect and becomes free again.
/// @param effect index among the variant's effects, of which `candidate` is the candidate
/// @return nothing if that cannot be simulated
std::optional<Fitted> without_effect(const Evaluator& evaluator, const ModelFit& fit,
                                     const Fitted& fitted, std::size_t effect,
                                     const Candidate& candidate);

/// The same fit with its last effect moved to another index; effects from there on move back by
/// one.
/// @return nothing if that cannot be simulated
std::optional<Fitted> with_last_effect_at(const ModelFit& fit, const Fitted& fitted,
                                          std::size_t index);

}  // namespace discovery
}  // namespace anthrob
