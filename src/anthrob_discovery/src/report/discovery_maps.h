#pragma once

#include <string>
#include <vector>

#include "conclusion/answer.h"

namespace anthrob {
namespace discovery {

/// Where the recalibrated model disagrees: the largest gaps, in words.
std::string where_table(const Answer& answer);

/// Heat map, place x regime: its speed, its load or else posture, its wrap angle, time, each in
/// three levels.
std::string regime_map(const Answer& answer);

/// Heat map, channel x quantity that is fed with measured values: a gap that disappears from one
/// column to the next arises in the part that was cut off.
std::string seam_map(const Answer& answer);

/// Curves of the residual of the recalibrated model over the quantities on which it depends most,
/// at places with a gap.
std::string dependences_of_gaps(const Answer& answer);

/// The same for the extended model.
std::string dependences_of_rest(const Answer& answer);

}  // namespace discovery
}  // namespace anthrob
