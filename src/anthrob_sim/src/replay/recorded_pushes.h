#pragma once

#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/replay/replay.h"

namespace anthrob {

/// The rows of wrenches.csv. A push acts while rows have cells of it; what they lack is zero. A
/// link that is pushed at several points is LINK, LINK:2 and so on.
/// @throws BadInput naming file, row and column: an unknown link, a number that is not finite
std::vector<PushRow> recorded_pushes(const SkeletonModel& skeleton, const Dataset& recording);

/// The link of a column's owner: LINK of "LINK:2".
std::string pushed_link(const std::string& owner);

}  // namespace anthrob
