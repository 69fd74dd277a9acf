#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace anthrob {
namespace discovery {

/// Gaps of a channel [floors]. Up to kRealGap, a gap may be due to a wrong estimate of the noise.
/// Above kFaintGap, it is still worth a search for what explains it, because the evidence is judged
/// by what the best model leaves, not by the floor.
constexpr double kRealGap = 1.4;
constexpr double kFaintGap = 1.15;
constexpr double kCertainGap = 2.0;  ///< no noise estimate is that wrong

/// Share of what an effect gains. A model without the effect that still lacks more than this after
/// a rough fit is not fitted further.
constexpr double kOutOfReach = 0.5;

/// Share of the squared gap that a law leaves of what it should explain, at which it is as likely
/// as not that the true law is another one. Measured by how often the answers of the study
/// (studies/notes.md), seeds 1 to 6, were right.
constexpr double kEvenOdds = 0.05;

/// Factor for the probability of a law with a shape parameter at the end of its range where that
/// parameter may have either sign: such a law tends to stand in for another one. Of 65 effects
/// named in the study (seeds 1 to 8) whose laws have such a shape, 7 ended there, none of them
/// right; of the other 58, 45 were right.
constexpr double kAtLimit = 0.05;
/// A parameter is at its limit if it is nearer to it than this share of its range.
constexpr double kNearLimit = 0.03;

/// What is so many standard errors over blocks is not due to chance.
constexpr double kSure = 3.0;

/// A held-out channel is spoilt if its gap ends at more than this times both the floor and what the
/// recalibrated model leaves.
constexpr double kSpoilt = 1.2;
/// What a law spoils, as a share of what it explains, at which it is as likely as not that the true
/// law is another one. Of 13 answers of the study (seeds 1 to 8) with a spoilt channel, 12 name an
/// effect that is not there; all effects of an answer together spoil 0.002 to 0.22 of what they
/// explain, that of the right answer 0.011.
constexpr double kEvenOddsSpoilt = 0.02;

/// A law whose probability, together with that of its rivals, is lower than this is not added to
/// the model. Of 15 effects in the study (seeds 1 to 6) that have less by themselves, two were
/// right, both in one robot; of those with 0.1 to 0.2, two of six.
constexpr double kImprobable = 0.1;

/// Part of a channel's squared gap above the square of a level, at least 0. [floors^2]
inline double excess(double gap, double least) {
  return std::max(0.0, gap * gap - least * least);
}

/// Gain in held-out log score that an effect needs to be named [nat]. It grows with the number of
/// candidates that were searched.
inline double needed_evidence(std::size_t candidates) {
  return 3.0 + std::log(static_cast<double>(std::max<std::size_t>(1, candidates)));
}

}  // namespace discovery
}  // namespace anthrob
