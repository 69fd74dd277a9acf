#pragma once

#include <optional>

#include "anthrob_calib/discovery/candidate.h"
#include "anthrob_calib/discovery/model_fit.h"

namespace anthrob {
namespace discovery {

/// How much worse recordings are predicted if an effect has a size that it has not, the ordinary
/// parameters fitted again: what they cannot take up, also where that is not linear.
class LikelihoodProfile {
 public:
  /// @param base fitted without the effect, its sensitivities known; it is fitted a little further,
  /// like what is compared with it, both by the fit's coarse step, whose error is in both
  LikelihoodProfile(const ModelFit& fit, Fitted base);

  /// The mean of both sides: what is in the data already makes one of them higher and the other
  /// lower.
  /// @param size index among the candidate's   @param doses how far from neutral
  /// @return by how much half the sum of squares rises [nat], what it costs to move ordinary
  /// parameters left out; nothing if a side cannot be simulated
  std::optional<double> rise(const Candidate& candidate, std::size_t size, double doses) const;

 private:
  const ModelFit& fit_;
  Fitted base_;
};

}  // namespace discovery
}  // namespace anthrob
