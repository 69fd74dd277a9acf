#pragma once

#include <string>
#include <vector>

namespace anthrob {

/// What of a robot goes into a bag.
enum class Recorded {
  kInputsAndMeasurements,  ///< what replays, calibration and discovery need
  kEverything,             ///< all topics of the robot, frames, the clock and diagnostics
};

/// The command that records a bag until it gets SIGINT.
/// @param robot its namespace from the root   @param file of the bag
/// @param duration [s] after which it ends by itself; 0: never
std::vector<std::string> record_command(const std::string& robot, Recorded what,
                                        const std::string& file, int duration);

}  // namespace anthrob
