#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace anthrob {
namespace discovery {

/// A channel's gap is one only beyond what a wrong estimate of the noise may look like [floors]. A
/// fainter one is worth a look for what would explain it: evidence is judged by what is left, not
/// by the floor.
constexpr double kRealGap = 1.4;
constexpr double kFaintGap = 1.15;

/// Share of what an effect gains. A model without it that lacks more after a rough fit does not get
/// there by a better one.
constexpr double kOutOfReach = 0.5;

/// Share of what a law was to explain: where it leaves that, it is as likely that the true one is
/// another. By how often answers of the study, seeds 1 to 6 (docs/studies), were right.
constexpr double kEvenOdds = 0.05;

/// A law whose shape ends where its range does, in a direction that nothing forbids, bends to do
/// another one's work: of 65 effects named in the study (seeds 1 to 8) whose laws have such a
/// shape, 7 ended there, none of them right; of the other 58 were 45.
constexpr double kAtLimit = 0.05;
/// So near its end, as a share of the range.
constexpr double kNearLimit = 0.03;

/// A law of less probability, its rivals' included, does not extend the model. Of 15 effects in the
/// study (seeds 1 to 6) that have less by themselves, two were right, both of one robot; of those
/// with 0.1 to 0.2, two of six.
constexpr double kImprobable = 0.1;

/// What of a channel's squared gap is more than that of a gap.
inline double excess(double gap, double least) {
  return std::max(0.0, gap * gap - least * least);
}

/// Gain in held-out log score that an effect must bring to be named [nat]: the more, the more
/// candidates were searched.
inline double needed_evidence(std::size_t candidates) {
  return 3.0 + std::log(static_cast<double>(std::max<std::size_t>(1, candidates)));
}

}  // namespace discovery
}  // namespace anthrob
