#pragma once

#include "conclusion/answer.h"

namespace anthrob {
namespace discovery {

/// A delay of all joints that is no longer than sampling makes is nothing that the model misses: it
/// is told among `measurement`, not among the effects. The extended model keeps it.
/// @param longest that sampling makes [s]
Answer with_sampled_delay(Answer answer, const RobotModel& robot, double longest);

}  // namespace discovery
}  // namespace anthrob
