#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "anthrob_calib/discovery/candidate.h"
#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/judge.h"

namespace anthrob {
namespace discovery {

/// A named effect of the model, with what the search has to remember about it.
struct NamedEffect {
  FoundEffect found;
  std::size_t candidate = 0;
  double gained = 0.0;                ///< reduction of the cost when it was named
  std::optional<std::size_t> fuller;  ///< candidate that says more at its place and did better on
                                      ///< held-out recordings in that round
  double before = 0.0;                ///< excess() of its channel when it was named; 0: not counted
};

/// Stores the held-out channel whose squared gap an effect reduces most.
/// @param judge of the residuals   @param without, with it
void note_what_it_shows_in(const Judge& judge, const Eigen::VectorXf& without,
                           const Eigen::VectorXf& with, NamedEffect& effect);

/// Stores for each effect the share of the squared gap that is left in its channel; 1 if it shows
/// in none.
/// @param first, left held-out residuals without any of the effects and with all of them
void measure_what_is_left(const Judge& judge, const Eigen::VectorXf& first,
                          const Eigen::VectorXf& left, std::vector<NamedEffect>& effects);

/// Name of a fitted shape parameter that may have either sign and is at the end of its range
/// (kNearLimit); empty: none.
std::string limit_of(const Candidate& candidate, const EffectInstance& instance);

/// Of the effects whose probability, with that of their rivals and lowered by trust_in(), is below
/// kImprobable: the one that gained least. Null: there is none.
const NamedEffect* least_of_improbable(const std::vector<NamedEffect>& effects);

}  // namespace discovery
}  // namespace anthrob
