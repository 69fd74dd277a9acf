#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"
#include "options/admission.h"

namespace anthrob {
namespace discovery {

/// By how much later, from its beginning, a repeat gets the same commands as the first recording
/// [s]; 0 if they start together. Commands are references or, without them, what was measured
/// instead: voltages, motor positions, the motion of a driven axis.
/// @throws BadInput with one line if it is not a repeat: it has other references, modes or another
/// motion. Single lost messages are accepted.
double lateness_of_repeat(const RobotModel& robot, const Dataset& first, const Dataset& repeat,
                          const RepeatOptions& options);

/// Whether the muscles get the same commands at the same times. False if there are no references.
bool have_same_commands(const RobotModel& robot, const Dataset& first, const Dataset& other,
                        const RepeatOptions& options);

}  // namespace discovery
}  // namespace anthrob
