#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"
#include "options/experiment.h"

namespace anthrob {
namespace discovery {

/// Whether the rows of a recording are poses of driven joints at rest, whose times mean nothing:
/// `kind: equilibrium` of a robot without muscles.
bool holds_poses(const RobotModel& robot, const Dataset& recording);

/// The same poses, as everything that goes by time can read them: one after the other every
/// PoseOptions::seconds, from time 0 on, in an order in which neighbours are alike. They are put in
/// order by the directions from which they were approached, then by position. Rows in which a
/// position, effort, load or direction that has a column is missing are left out; a missing
/// direction is 0. Poses that are in order stay as they are.
/// @param remarks gets what is left out; may be null
/// @throws BadInput for columns that are missing or in different files, for other directions than
/// -1, 0 and 1, and for fewer poses than PoseOptions::fewest
Dataset ordered_poses(const RobotModel& robot, const Dataset& recording, const PoseOptions& options,
                      std::vector<std::string>* remarks = nullptr);

}  // namespace discovery
}  // namespace anthrob
