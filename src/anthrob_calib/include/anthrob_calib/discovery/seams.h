#pragma once

#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/preparation.h"

namespace anthrob {
namespace discovery {

/// Replays the training recordings, fed with measured values at four seams, so that
/// an error shows behind the seam where it arises and not behind all of them.
std::vector<SeamGap> seam_gaps(const Evaluator& evaluator, const Question& question,
                               const Laboratory& laboratory, const Scales& scales,
                               const Variant& variant);

/// The part of the chain that a channel's gaps point at.
std::string subsystem_of(const SeamGap& gap);

}  // namespace discovery
}  // namespace anthrob
