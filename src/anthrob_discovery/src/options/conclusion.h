#pragma once

#include "options/share.h"

namespace anthrob {
namespace discovery {

/// The verdict.
struct ConclusionOptions {
  Share most_remains = 0.45;  ///< of the squared gap that an answer may leave
  /// [floors] in the motion of a driven axis: noise leaves about one, whatever is fitted
  double least_left = 0.5;
  /// [floors] of a named effect in the motion of a driven axis: evidence adds up over bins, but so
  /// do small errors of the motion. A bench with nothing missing had 0.58, by 0.8 % of its
  /// accelerations that smoothing takes
  double least_effort = 1.0;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("most_remains", options.most_remains);
    visit("least_left", options.least_left);
    visit("least_effort", options.least_effort);
  }
};

}  // namespace discovery
}  // namespace anthrob
