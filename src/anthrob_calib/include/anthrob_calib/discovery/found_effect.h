#pragma once

#include <vector>

#include "anthrob_calib/discovery/candidate.h"
#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/naming.h"

namespace anthrob {
namespace discovery {

constexpr double kMentioned = 0.02;  ///< least probability of a rival

/// The first of a list, the others its rivals.
FoundEffect found_effect(const ShortList& list, const std::vector<Candidate>& candidates);

/// A law that says more at an effect's place, or the same everywhere, does better: it is named, the
/// other its rival. What it had as a rival is its own.
/// @param odds against the other
/// @return whether that is the first rival: what tells the two apart is to be planned
bool name_instead(const Candidate& fuller, const Naming::Odds& odds, FoundEffect& effect);

/// It does only nearly as well or a little better: what says less stays named, the other is its
/// first rival, as probable.
void leave_open(const Candidate& fuller, const Naming::Odds& odds, FoundEffect& effect);

}  // namespace discovery
}  // namespace anthrob
