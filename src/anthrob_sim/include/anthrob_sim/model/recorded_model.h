#pragma once

#include <memory>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {

/// The robot as it was in a recording: with the numbers of `model` in its meta.yaml instead of
/// those of the model file and of `options.overrides`.
/// @throws BadInput that names recording and key, where the model has no such number; as
/// RobotDescription::build()
std::shared_ptr<const RobotModel> build_recorded(const RobotDescription& robot,
                                                 const Dataset& recording,
                                                 LoadOptions options = {});

}  // namespace anthrob
