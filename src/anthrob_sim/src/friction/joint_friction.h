#pragma once

#include <cmath>

#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {

/// Dry part of the Stribeck curve (3.6): torque that opposes a speed, or bounds the holding torque
/// at rest.
inline double dry_friction(const JointFrictionModel& friction, double speed) {
  return friction.kinetic_torque + (friction.static_torque - friction.kinetic_torque) *
                                       std::exp(-std::abs(speed) / friction.stribeck_velocity);
}

/// Additional dry friction: direction-dependent part (single-dof joints) plus load-dependent part
/// [Nm or N].
/// @param direction of motion   @param load force that the joint carries [N]
inline double extra_dry_friction(const JointFrictionModel& friction, double direction,
                                 double load) {
  return (direction > 0.0 ? friction.forward : friction.backward) + friction.load_radius * load;
}

}  // namespace anthrob
