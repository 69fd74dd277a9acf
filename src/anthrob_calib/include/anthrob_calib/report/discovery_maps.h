#pragma once

#include <string>
#include <vector>

#include "anthrob_calib/discovery/discovery.h"

namespace anthrob {
namespace discovery {

/// Where the recalibrated model disagrees: the largest gaps, in words.
std::string where_table(const Answer& answer);

/// Heat map, place x regime: its speed, its load or else posture, its wrap angle, time, each in
/// three levels.
std::string regime_map(const Answer& answer);

/// Heat map, channel x what is fed with measured values: a gap that vanishes to the right belongs
/// to what was cut off.
std::string seam_map(const Answer& answer);

/// Curves of what the recalibrated model leaves where it disagrees, over what it depends on most.
std::string dependences_of_gaps(const Answer& answer);

/// The same of what remains in the end.
std::string dependences_of_rest(const Answer& answer);

}  // namespace discovery
}  // namespace anthrob
