#pragma once

#include <string>

#include "anthrob_ecu/control_law.h"
#include "anthrob_recording/dataset.h"

namespace anthrob {

/// Commands to a muscle's motor unit over time. `mode` is empty if it was not recorded.
struct CommandSeries {
  Series mode, reference;
};

/// The commands that a muscle's unit actually followed. If the recording contains `ecu_state`,
/// together with the mode and reference in force, then commands that the unit refused or got while
/// it was not ENABLED are left out, and from each stop on the command is VOLTAGE 0 until a later
/// command. The series begins at time 0 if the recording says what was in force there.
/// @param default_mode mode of commands without a recorded mode
CommandSeries followed_commands(const Dataset& recording, const std::string& muscle,
                                ecu::Mode default_mode);

/// Checks that the recording contains every command that the unit followed.
/// @throws BadInput with the time, if the unit followed a command that was not recorded
void require_commanded(const Dataset& recording, const std::string& muscle,
                       const CommandSeries& followed);

}  // namespace anthrob
