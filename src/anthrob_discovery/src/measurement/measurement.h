#pragma once

#include "experiment/evaluator.h"
#include "measurement/description.h"

namespace anthrob {
namespace discovery {

/// Undoes what the recordings themselves say of how they were taken (`measurement` in meta.yaml).
/// @throws BadInput
Description as_stated(const RobotModel& robot, const Question& question);

/// Finds out how the recordings were taken, and undoes what is not as the model's `sensors:` say.
/// @param stated whose question was admitted
Description describe(const Evaluator& evaluator, Description stated);

}  // namespace discovery
}  // namespace anthrob
