#pragma once

#include "anthrob_calib/discovery/discovery.h"

namespace anthrob {
namespace discovery {

/// Discovery where the robot itself is at hand, as a simulation: while what was found has rivals
/// and a recording is known that tells them apart, the robot is recorded so and the question asked
/// again with that recording beside the others.
/// @param robot as it really is; only recorded
/// @param question gets the new recordings: every other target to learn from, the rest to judge by
/// @throws BadInput, Interrupted
Answer discover_in_a_loop(const Evaluator& evaluator, Question& question,
                          const std::shared_ptr<const RobotModel>& robot);

/// Folders that the recordings of a loop may be kept in: "separating_1_train", ...
std::vector<std::string> loop_recordings();
/// Removes those of an earlier loop from a folder. @param made names of those of this one
void remove_other_recordings(const std::string& folder, const std::vector<std::string>& made);

}  // namespace discovery
}  // namespace anthrob
