#pragma once

#include <string>
#include <vector>

#include "anthrob_sim/model/robot_model.h"

namespace anthrob {
namespace discovery {

/// The robot at rest as SVG text, seen along y and along x of the world (z upwards): bones,
/// muscles, and in red what lies at `places` (those of effects: a muscle, an entry of its path, a
/// joint, a body). Empty if the robot has no extent to draw.
std::string robot_figure(const RobotModel& robot, const std::vector<std::string>& places);

}  // namespace discovery
}  // namespace anthrob
