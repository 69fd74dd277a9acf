#pragma once

#include "anthrob_sim/model/robot_model.h"
#include "measurement/description.h"

namespace anthrob {
namespace discovery {

/// Leaves of slower sensors in faster rows only what is fresh, at the times of their own clocks.
/// Inputs (voltages, efforts, references) do hold from row to row, and stay.
void correct_holds(const RobotModel& robot, Description& description);

}  // namespace discovery
}  // namespace anthrob
