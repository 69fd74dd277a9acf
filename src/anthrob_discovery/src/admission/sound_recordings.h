#pragma once

#include <string>
#include <vector>

#include "anthrob_sim/model/robot_model.h"
#include "question/question.h"

namespace anthrob {
namespace discovery {

/// Refuses time that runs backwards, files that do not share a clock, and numbers that nobody can
/// have measured (recordings/plausible_values.h).
/// @throws BadInput with file, row and column
void refuse_nonsense(const RobotModel& robot, const Dataset& recording,
                     const SoundnessOptions& options);

/// Says where many rows have the time of the row before.
std::vector<std::string> remarks_on_stamps(const Dataset& recording,
                                           const SoundnessOptions& options);

/// Recordings that are fitted cannot judge, and a copy of a recording shows no noise: refuses
/// recordings that were given twice, whole or in part.
/// @throws BadInput
void refuse_copies(const Question& question);

}  // namespace discovery
}  // namespace anthrob
