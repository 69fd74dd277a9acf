#pragma once

#include "anthrob_calib/discovery/discovery.h"

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
                          const std::shared_ptr<const RobotModel>& robot);

/// Names of the folders in which the recordings of a loop are saved: "separating_1_train", ...
std::vector<std::string> loop_recordings();
/// Removes recordings of an earlier loop from a folder. @param made names of the recordings of this
/// loop, which stay
void remove_other_recordings(const std::string& folder, const std::vector<std::string>& made);

}  // namespace discovery
}  // namespace anthrob
