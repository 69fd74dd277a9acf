#include <algorithm>

#include "anthrob_sim/sensing/sensor.h"

namespace anthrob {

double pad_force(const TouchPadModel& pad, const KinematicTree& tree,
                 const std::vector<double>& q) {
  const JointModel& joint = tree.model().joints[pad.joint];
  const double depth = q[joint.position_offset] - joint.stop.upper;
  if (depth <= 0.0) return 0.0;
  const double torque =
      joint.stop.stiffness * depth + joint.stop.damping * tree.velocities()[joint.velocity_offset];
  return pad.share * std::max(0.0, torque) / pad.lever;
}

}  // namespace anthrob
