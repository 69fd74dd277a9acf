#pragma once

#include "anthrob_sim/model/robot_model.h"
#include "discover.h"

namespace anthrob {
namespace discovery {

/// Discovery with access to a simulated robot. While an effect that was found has rivals and a
/// separating recording is known, the robot is recorded with it, and discovery runs again with that
/// recording added; at most twice.
/// @param robot model of the simulated robot; only used to record it. It must have the muscles and
/// joints of the examined model.
/// @param question gets the new recordings: every other target in `train`, the rest in `test`
/// @throws BadInput, Interrupted
Answer discover_in_a_loop(const Evaluator& evaluator, Question& question,
                          const std::shared_ptr<const RobotModel>& robot,
                          const Observer& observer = {});

/// Names of the folders in which the recordings of a loop are saved: "separating_1_train", ...
std::vector<std::string> loop_recordings(const LoopOptions& options);

}  // namespace discovery
}  // namespace anthrob
