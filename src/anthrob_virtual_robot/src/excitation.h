#pragma once

#include <vector>

#include "anthrob_reference/parameters.h"
#include "random.h"

namespace anthrob::virtual_robot {

/// References of all muscles [rad], in force from a time on [s].
struct Command {
  double t = 0.0;
  std::vector<double> references;
};

/// Motion through the whole workspace that makes most effects of an arm visible: slow and fast
/// motion, pauses, the same posture from several sides and at several levels of co-contraction,
/// small reversals. References are computed with the believed model.
std::vector<Command> excitation(const reference::ArmParameters& believed, double seconds,
                                Random random);

}  // namespace anthrob::virtual_robot
