#pragma once

#include <vector>

#include "anthrob_reference/parameters.h"
#include "anthrob_virtual_robot/random.h"

namespace anthrob::virtual_robot {

/// References of all muscles from a time on [s], [rad].
struct Command {
  double t = 0.0;
  std::vector<double> references;
};

/// Moves through postures of the whole workspace that show most of what an arm can have: slow and
/// fast motion, pauses, the same posture from several sides and at several levels of
/// co-contraction, small reversals. References are those of the model that one believes in.
std::vector<Command> excitation(const reference::ArmParameters& believed, double seconds,
                                Random random);

}  // namespace anthrob::virtual_robot
