#pragma once

#include <vector>

#include "anthrob_calib/discovery/candidate.h"
#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/judge.h"
#include "anthrob_calib/discovery/screening.h"

namespace anthrob {
namespace discovery {

/// What recordings can show, before any effect is named: of each candidate the smallest size that
/// would mostly (nineteen times out of twenty) be named, and the groups that nothing tells apart.
///
/// What is named must gain on held-out data, and some channel must show a gap without it.
class PreFlight {
 public:
  /// @param base fit of the ordinary parameters
  /// @param train, test judges of what it was fitted to and of what is held out
  /// @param held_out length of the latter [s]
  PreFlight(const std::vector<Candidate>& candidates, const Fitted& base, const Judge& train,
            const Judge& test, double held_out);

  /// Fills in `visible`, `not_visible` and `alike`.
  void fly(const Screening& screening, std::vector<Score> scores, Answer& answer) const;

 private:
  Visibility visibility_of(const Score& score, double doses_for_gap) const;
  double taken_for_ordinary(const Candidate& candidate) const;

  const std::vector<Candidate>& candidates_;
  const Fitted& base_;
  const Judge &train_, &test_;
  double held_out_;
};

}  // namespace discovery
}  // namespace anthrob
