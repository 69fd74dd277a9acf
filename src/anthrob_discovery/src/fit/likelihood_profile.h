#pragma once

#include <optional>

#include "fit/candidate.h"
#include "fit/model_fit.h"

namespace anthrob {
namespace discovery {

/// How much worse the recordings are predicted if an effect of a given size is put into the model
/// and the ordinary parameters are fitted again: what they cannot imitate, also where that is not
/// linear.
class LikelihoodProfile {
 public:
  /// @param base fitted without the effect, with sensitivities. It is fitted a little further, like
  /// the fits that are compared with it; all use the coarse step of the fit, so that its error
  /// cancels
  LikelihoodProfile(const ModelFit& fit, Fitted base);

  /// Returns the mean for the size to either side of neutral, because an effect that is really
  /// there makes one side worse and the other better.
  /// @param size index among the candidate's   @param doses how far from neutral
  /// @param needed rise that is asked for [nat]; iterations end where they change less than a
  /// twentieth of it
  /// @return the rise of half the sum of squares [nat], without the cost of moving ordinary
  /// parameters from where they are expected; nothing if one side cannot be simulated
  std::optional<double> rise(const Candidate& candidate, std::size_t size, double doses,
                             double needed) const;

 private:
  const ModelFit& fit_;
  Fitted base_;
};

}  // namespace discovery
}  // namespace anthrob
