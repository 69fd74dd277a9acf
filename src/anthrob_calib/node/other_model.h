#pragma once

#include <memory>
#include <string>

#include "anthrob_sim/model/robot_model.h"

namespace anthrob {

/// Loads another model of the same robot.
/// @param file path of a model file, or a name such as anthrob/II
/// @throws BadInput if it cannot be loaded, or has other muscles or joints
std::shared_ptr<const RobotModel> other_model(const std::string& file, const RobotModel& present);

}  // namespace anthrob
