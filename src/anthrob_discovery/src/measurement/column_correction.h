#pragma once

#include <optional>
#include <vector>

#include "anthrob_sim/model/robot_model.h"
#include "measurement/description.h"

namespace anthrob {
namespace discovery {

/// Columns of muscles with another sign or unit than all others, found in the recordings alone:
///   position   follows the reference of position control
///   velocity   integrates to the position
///   current    is (voltage - K_E N velocity) / R
/// Corrected and reported. Velocities of joints are only told about, because nothing says which of
/// velocity and position it is.
void correct_columns(const RobotModel& robot, Description& description);

/// Forces and positions of joints, beside what the given model does.
/// @param simulated replays() of all recordings: train, test, repeats
void correct_columns_by_model(const RobotModel& robot,
                              const std::vector<std::optional<Dataset>>& simulated,
                              Description& description);

}  // namespace discovery
}  // namespace anthrob
