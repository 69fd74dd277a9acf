#pragma once

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {
namespace discovery {

/// The current that a muscle's recorded voltage and position give by its motor's equation,
/// (V - K_E N velocity) / R, in the rows of the voltage [A]; empty where
/// something is missing, or positions are measured too seldom for a velocity.
/// @param beside time to either side over which the velocity is taken [s]
Series expected_current(const MuscleModel& muscle, const Dataset& recording, double beside);

}  // namespace discovery
}  // namespace anthrob
