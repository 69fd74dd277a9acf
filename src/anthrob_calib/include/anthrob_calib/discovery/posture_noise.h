#pragma once

#include <cstdint>

#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/recording/dataset.h"

namespace anthrob {
namespace discovery {

/// A recording whose joint positions have less of their sensors' noise: each is that of a parabola
/// through the three rows before and after it, in time, too. Motions of the arm are slower.
Dataset with_smooth_postures(const RobotModel& robot, const Dataset& recording);

/// A recording whose joint positions have noise once more: white, as strong as that which is in
/// them already, by column. Smoothed and replayed beside the one without, it tells what is left of
/// the noise, and what that does.
Dataset with_noisier_postures(const RobotModel& robot, const Dataset& recording,
                              std::uint64_t seed);

}  // namespace discovery
}  // namespace anthrob
