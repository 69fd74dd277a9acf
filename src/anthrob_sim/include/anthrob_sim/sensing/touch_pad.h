#pragma once

#include <string>

#include "anthrob_sim/skeleton/kinematic_tree.h"

namespace anthrob {

/// A force-sensitive resistor on a hand that closes on itself: at the end of its travel, fingers
/// and palm press on each other, and each pad carries its share of that. It feels no other bodies.
struct TouchPadModel {
  std::string name;
  int joint = 0;       ///< hinge whose upper stop is the closed hand
  double lever = 0.0;  ///< from the hinge to the pad [m], > 0
  double share = 0.0;  ///< of the stop's torque that this pad carries [1], 0..1
};

/// Force normal to the pad [N], >= 0.
double pad_force(const TouchPadModel& pad, const KinematicTree& tree, const std::vector<double>& q);

}  // namespace anthrob
