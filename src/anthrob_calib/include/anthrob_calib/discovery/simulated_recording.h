#pragma once

#include <cstdint>
#include <memory>

#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/recording/dataset.h"

namespace anthrob {
namespace discovery {

/// What a simulated robot measures, with its sensors, while it is commanded as in `commands`:
/// 200 rows a second of muscles, joints and spherical joints beside the commands.
/// @param seed of the sensors' noise   @throws NumericalFailure
Dataset simulated_recording(const std::shared_ptr<const RobotModel>& robot, const Dataset& commands,
                            std::uint64_t seed);

}  // namespace discovery
}  // namespace anthrob
