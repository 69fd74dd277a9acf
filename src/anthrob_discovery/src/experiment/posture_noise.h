#pragma once

#include <cstdint>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"
#include "options/experiment.h"

namespace anthrob {
namespace discovery {

/// The recording with smoothed joint positions: each is replaced by the value of a parabola over
/// time through it and the three rows before and after it.
Dataset with_smooth_postures(const RobotModel& robot, const Dataset& recording,
                             const PostureNoiseOptions& options);

/// The recording with white noise added to the joint positions, as strong as what each column has
/// already. Smoothed and replayed like the original, it shows what the noise that smoothing leaves
/// does to the forces.
Dataset with_noisier_postures(const RobotModel& robot, const Dataset& recording,
                              std::uint64_t seed);

}  // namespace discovery
}  // namespace anthrob
