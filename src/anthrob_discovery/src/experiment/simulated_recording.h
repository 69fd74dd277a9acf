#pragma once

#include <cstdint>
#include <memory>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"
#include "options/experiment.h"

namespace anthrob {
namespace discovery {

/// What the sensors of a simulated robot measure while it gets the commands of `commands`: muscles,
/// joints and spherical joints at 200 rows per second, together with the commands.
/// @param seed of the sensors' noise   @throws NumericalFailure
Dataset simulated_recording(const std::shared_ptr<const RobotModel>& robot, const Dataset& commands,
                            std::uint64_t seed, const ExperimentOptions& options);

}  // namespace discovery
}  // namespace anthrob
