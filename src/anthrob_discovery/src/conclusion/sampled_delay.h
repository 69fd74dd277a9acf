#pragma once

#include "conclusion/answer.h"

namespace anthrob {
namespace discovery {

/// A delay that is no longer than sampling makes is nothing that the model misses: it is told among
/// `measurement`, not among the effects. The extended model keeps it. Sampling makes joints late,
/// and readings and references of controllers by less than one of their ticks. Where the joints'
/// clock was moved, any delay of theirs may be what is left of its offset.
/// @param longest that sampling makes joints late [s]
Answer with_sampled_delays(Answer answer, const RobotModel& robot, double longest);

}  // namespace discovery
}  // namespace anthrob
