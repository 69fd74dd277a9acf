#pragma once

#include "anthrob_sim/model/robot_model.h"
#include "measurement/description.h"

namespace anthrob {
namespace discovery {

/// Moves voltages, positions and forces to the times at which the controllers' law has them
/// (ControllerAlgebra), and says where no shift makes the law give the recorded voltages.
/// @param config of the model file
void correct_controller_stamps(const RobotModel& robot, const ConfigNode& config,
                               Description& description);

}  // namespace discovery
}  // namespace anthrob
