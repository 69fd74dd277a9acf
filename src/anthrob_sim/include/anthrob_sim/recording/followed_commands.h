#pragma once

#include <string>

#include "anthrob_ecu/control_law.h"
#include "anthrob_sim/recording/dataset.h"

namespace anthrob {

/// What a muscle's motor unit was told over time. `mode` is empty where nobody said it.
struct CommandSeries {
  Series mode, reference;
};

/// A muscle's recorded commands, as its unit followed them: where a recording holds `ecu_state`,
/// and with it the mode and reference in force, commands that the unit refused or met while it was
/// not ENABLED are left out, and from each stop on it has VOLTAGE 0 until a later command. The
/// series begins at time 0 if the recording says what was in force there.
/// @param unsaid mode of commands without one
CommandSeries followed_commands(const Dataset& recording, const std::string& muscle,
                                ecu::Mode unsaid);

/// @throws BadInput with the time, if the unit followed something for which there is no command
void require_commanded(const Dataset& recording, const std::string& muscle,
                       const CommandSeries& followed);

}  // namespace anthrob
