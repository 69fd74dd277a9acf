#pragma once

#include <vector>

#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/fit/candidate.h"
#include "anthrob_calib/discovery/fit/likelihood_profile.h"
#include "anthrob_calib/discovery/fit/model_fit.h"
#include "anthrob_calib/discovery/judgement/judge.h"
#include "anthrob_calib/discovery/search/screening.h"

namespace anthrob {
namespace discovery {

/// Finds out what the recordings can show before any effect is named: for each candidate the
/// smallest size that would be named nineteen times out of twenty, and the groups of candidates
/// that nothing tells apart.
///
/// To be named, an effect must gain enough on held-out recordings, and some channel must show a gap
/// without it ("What is visible" in docs/discovery_method.md).
class Detectability {
 public:
  /// @param fit to the training recordings   @param base the fit of the ordinary parameters
  /// @param train, test judges of training and held-out recordings
  /// @param held_out length of the held-out recordings [s]
  Detectability(const std::vector<Candidate>& candidates, const ModelFit& fit, const Fitted& base,
                const Judge& train, const Judge& test, double held_out);

  /// Fills in `visible`, `not_visible` and `alike`.
  void run(const Screening& screening, std::vector<Score> scores, Answer& answer) const;

 private:
  double doses_for_evidence(const Score& score) const;
  /// Checks turns of the world or of the observer by fitting, because ordinary parameters of all
  /// muscles together imitate them, and not linearly.
  void check_turns(const std::vector<Score>& scores, std::vector<double>& doses) const;
  /// Increases a number of doses until nine tenths of the predicted evidence are left. @return that
  /// number; infinite if it cannot be simulated or nothing is left
  double checked(const LikelihoodProfile& profile, const Score& score, double doses) const;
  Visibility visibility_of(const Score& score, double doses) const;
  /// Whether a size so far from neutral is realistic: at most five doses, and within its bounds.
  bool is_met(const Score& score, double doses) const;
  double taken_for_ordinary(const Candidate& candidate) const;

  const std::vector<Candidate>& candidates_;
  const ModelFit& fit_;
  const Fitted& base_;
  const Judge &train_, &test_;
  double held_out_;
};

}  // namespace discovery
}  // namespace anthrob
