#pragma once

#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"
#include "options/admission.h"

namespace anthrob {
namespace discovery {

/// Largest less smallest value; 0 of an empty series.
double range_of(const Series& series);

/// Whether a measured series changes by more than `least` and by more than its white noise does.
bool moves(const Series& series, double least, const MovementOptions& options);

/// Checks that something moves in one of the recordings: without motion, there is nothing to learn.
/// @throws BadInput with one line
void refuse_stillness(const RobotModel& robot, const std::vector<Dataset>& recordings,
                      const MovementOptions& options);

}  // namespace discovery
}  // namespace anthrob
