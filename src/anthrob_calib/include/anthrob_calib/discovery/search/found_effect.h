#pragma once

#include <vector>

#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/fit/candidate.h"
#include "anthrob_calib/discovery/search/candidate_comparison.h"

namespace anthrob {
namespace discovery {

constexpr double kMentioned = 0.02;  ///< least probability of a rival

/// The first of a short list as a found effect, with the others as its rivals.
FoundEffect found_effect(const ShortList& list, const std::vector<Candidate>& candidates);

/// Replaces a named effect by a law that does better: one that says more at the same place, or the
/// same law everywhere. The replaced law becomes its rival. The two share what both had, the new
/// law as a rival, by the odds.
/// @param odds against the other
/// @return whether the replaced law is the first rival, so that a separating experiment is to be
/// planned
bool name_instead(const Candidate& fuller, const CandidateComparison::Odds& odds,
                  FoundEffect& effect);

/// The law that says more is not clearly better: the simpler law stays named, and the other one
/// becomes its first rival, with the same probability.
void leave_open(const Candidate& fuller, const CandidateComparison::Odds& odds,
                FoundEffect& effect);

}  // namespace discovery
}  // namespace anthrob
