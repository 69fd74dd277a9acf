#pragma once

#include <vector>

#include "anthrob_calib/discovery/candidate.h"
#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/judge.h"
#include "anthrob_calib/discovery/likelihood_profile.h"
#include "anthrob_calib/discovery/model_fit.h"
#include "anthrob_calib/discovery/screening.h"

namespace anthrob {
namespace discovery {

/// What recordings can show, before any effect is named: of each candidate the smallest size that
/// would mostly (nineteen times out of twenty) be named, and the groups that nothing tells apart.
///
/// What is named must gain on held-out data, and some channel must show a gap without it.
class PreFlight {
 public:
  /// @param fit to what is there to learn from   @param base that of the ordinary parameters
  /// @param train, test judges of what it was fitted to and of what is held out
  /// @param held_out length of the latter [s]
  PreFlight(const std::vector<Candidate>& candidates, const ModelFit& fit, const Fitted& base,
            const Judge& train, const Judge& test, double held_out);

  /// Fills in `visible`, `not_visible` and `alike`.
  void fly(const Screening& screening, std::vector<Score> scores, Answer& answer) const;

 private:
  double doses_for_evidence(const Score& score) const;
  /// Ordinary parameters of all muscles together imitate a turn of the world, or of who looks at
  /// it, and not linearly.
  void check_turns(const std::vector<Score>& scores, std::vector<double>& doses) const;
  /// So many doses or as many more as it takes until as much is left as is reckoned of them; as far
  /// as they are met.
  double checked(const LikelihoodProfile& profile, const Score& score, double doses) const;
  Visibility visibility_of(const Score& score, double doses) const;
  /// Whether sizes so far from neutral are ones that one meets.
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
