#pragma once

#include "anthrob_recording/dataset.h"

namespace anthrob {

/// Longest gap of a measurement with which a recording can still be used [s].
constexpr double kLongestLoss = 0.05;

/// Empties cells that contain no measurement, so that they count as not measured:
/// - NaN for at most kLongestLoss, which the recorder accepts, too.
/// - State and mode in the same rows, if the motor unit did not answer in time: FAULT and VOLTAGE 0
///   then come from the driver, not from the unit. They stay if the unit is in FAULT when it
///   answers again, because then the driver had stopped it.
/// - All forces of a muscle without a single number: it has no force sensor.
/// NaN for longer stays NaN, so that the recording is refused later.
void leave_out_unanswered(Dataset& recording);

}  // namespace anthrob
