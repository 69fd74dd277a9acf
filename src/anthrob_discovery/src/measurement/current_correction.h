#pragma once

#include "anthrob_sim/model/robot_model.h"
#include "measurement/description.h"

namespace anthrob {
namespace discovery {

/// Moves currents to when voltages and velocities of their motors ask for them. The current of a
/// motor follows its voltage within less than a millisecond, and neither friction nor load delays
/// it, so what comes later is sampling: a delay, an average or a filter.
void correct_currents(const RobotModel& robot, Description& description);

}  // namespace discovery
}  // namespace anthrob
