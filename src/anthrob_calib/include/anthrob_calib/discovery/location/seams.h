#pragma once

#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/search/preparation.h"

namespace anthrob {
namespace discovery {

/// Replays the training recordings four times, fed with measured values at one point (seam) of the
/// chain after the other. A gap that disappears arises in the part that was cut off.
std::vector<SeamGap> seam_gaps(const Evaluator& evaluator, const Question& question,
                               const PreparedRecordings& recordings, const Scales& scales,
                               const Variant& variant);

/// Whether measured postures make a force so much worse that their own errors must be in it. Up to
/// twice as bad is natural: an imposed posture does not give way to a wrong force.
bool postures_mislead(const SeamGap& gap);

/// The part of the chain to which the gaps of a channel point, in words.
std::string subsystem_of(const SeamGap& gap);

}  // namespace discovery
}  // namespace anthrob
