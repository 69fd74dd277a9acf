#pragma once

#include "anthrob_sim/recording/dataset.h"

namespace anthrob {

/// How long a sensor may have been silent and the recording still be used [s].
constexpr double kLongestLoss = 0.05;

/// Empties the cells that tell nothing of the robot, so that they count as not measured:
/// - What was not measured (NaN) for no longer than kLongestLoss, which the recorder accepts, too.
/// - The words beside it of a motor unit that did not answer in time: FAULT and VOLTAGE 0 are the
///   driver's, not the unit's. But not where the unit is in FAULT when it answers again: there the
///   driver had stopped it.
/// - Forces of a muscle of which there is no number: it has no such sensor.
/// What was not measured for longer stays NaN, to be refused.
void leave_out_unanswered(Dataset& recording);

}  // namespace anthrob
