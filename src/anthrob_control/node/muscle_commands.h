#pragma once

#include <anthrob_msgs/MuscleCommand.h>

#include "anthrob_sim/model/robot_model.h"

namespace anthrob {

/// A position command for every muscle that has a controller.
inline anthrob_msgs::MuscleCommand command_for(const RobotModel& model,
                                               const std::vector<double>& references) {
  anthrob_msgs::MuscleCommand command;
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    if (!model.muscles[m].has_controller) continue;
    command.name.push_back(model.muscles[m].name);
    command.mode.push_back(anthrob_msgs::MuscleCommand::POSITION);
    command.reference.push_back(references[m]);
  }
  return command;
}

}  // namespace anthrob
