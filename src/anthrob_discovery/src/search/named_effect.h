#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fit/candidate.h"
#include "judgement/judge.h"
#include "search/named_law.h"

namespace anthrob {
namespace discovery {

/// A named effect of the model, with what the search has to remember about it.
struct NamedEffect {
  NamedLaw found;
  std::optional<Contest> contest;  ///< with its first rival, where a recording may decide it
  std::size_t candidate = 0;
  double gained = 0.0;                ///< reduction of the cost when it was named
  std::optional<std::size_t> fuller;  ///< candidate that says more at its place and did better on
                                      ///< held-out recordings in that round
  double before = 0.0;                ///< excess() of its channel when it was named; 0: not counted
  std::map<std::string, double> raised;  ///< by how much it raised the squared gaps of held-out
                                         ///< channels when it was named, where it did [floors^2]
  double lowered = 0.0;  ///< by how much it lowered those of the others, together [floors^2]
};

/// Stores the held-out channel whose squared gap an effect reduces most, what it takes from all of
/// them, and those that it raises.
/// @param judge of the residuals   @param without, with it
void note_what_it_changes(const Judge& judge, const Eigen::VectorXf& without,
                          const Eigen::VectorXf& with, NamedEffect& effect);

/// Stores for each effect the share of the squared gap that is left in its channel; 1 if it shows
/// in none.
/// @param first, left held-out residuals without any of the effects and with all of them
void measure_what_is_left(const Judge& judge, const Eigen::VectorXf& first,
                          const Eigen::VectorXf& left, std::vector<NamedEffect>& effects);

/// Name of a fitted shape parameter that may have either sign and is at the end of its range
/// (TrustOptions::near_limit); nothing if there is none.
std::optional<std::string> limit_of(const Candidate& candidate, const EffectInstance& instance,
                                    const TrustOptions& options);

/// Charges every spoilt channel (TrustOptions::spoilt) to the effect that raised it most when it
/// was named. Stores for each effect the worst channel that it is charged with, and by how much all
/// of these are worse, as a share of what the effect explains. What none raised is charged to none.
/// @param first, left held-out residuals without any of the effects and with all of them
/// @return whether any effect is charged
bool charge_spoilt_channels(const Judge& judge, const Eigen::VectorXf& first,
                            const Eigen::VectorXf& left, std::vector<NamedEffect>& effects);

/// Of the effects whose probability, with that of their rivals and lowered by trust_in(), is below
/// TrustOptions::improbable: the one that gained least. Null: there is none.
/// @param left_counts whether what a law leaves of the gap speaks against it
const NamedEffect* least_of_improbable(const std::vector<NamedEffect>& effects, bool left_counts,
                                       const TrustOptions& options);

}  // namespace discovery
}  // namespace anthrob
