#pragma once

#include <string>
#include <vector>

#include "anthrob_sim/model/robot_model.h"
#include "question/question.h"

namespace anthrob {
namespace discovery {

/// Empties columns of muscles that never change although their muscle must have moved, as those of
/// a dead sensor. Without noise, such a channel would have next to no floor and outweigh all
/// others.
///
/// A muscle must have moved if its reference in POSITION mode did (or, for a force without
/// references, its measured motor position), no less than a quarter of what others did, and if
/// other muscles or joints were seen to move. A force of 0 stays: its tendon may be slack.
///
/// A repeat needs the channels of the first training recording: what is left out of one of them is
/// left out of all.
/// @return a remark for each column
std::vector<std::string> leave_out_frozen(const RobotModel& robot, Question& question);

}  // namespace discovery
}  // namespace anthrob
