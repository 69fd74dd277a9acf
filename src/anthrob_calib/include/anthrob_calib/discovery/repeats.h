#pragma once

#include <string>
#include <vector>

#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/recording/dataset.h"

namespace anthrob {
namespace discovery {

/// Recordings that start no further apart than this start together: as much as the messages of a
/// controller come early or late [s].
constexpr double kTogether = 0.05;

/// How much later, from its beginning on, a repeat is told what another recording is told; 0 where
/// they start together [s]. References count, where there are none what was measured instead:
/// voltages, motor positions, the motion of a driven axis.
/// @throws BadInput with one line if it is no repeat: other references, modes or another motion. A
/// message that was lost makes no other commands.
double lateness_of_repeat(const RobotModel& robot, const Dataset& first, const Dataset& repeat);

/// Whether the muscles are told the same at the same times. Where nothing is told they are not.
bool have_same_commands(const RobotModel& robot, const Dataset& first, const Dataset& other);

}  // namespace discovery
}  // namespace anthrob
