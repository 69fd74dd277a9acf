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

/// Dry friction in proportion to what a joint carries and to what drives it [Nm or N].
/// @param load force that the joint carries [N]   @param effort that drives it [Nm or N]
inline double proportional_friction(const JointFrictionModel& friction, double load,
                                    double effort) {
  return friction.load_radius * load + friction.effort_share * std::abs(effort);
}

/// Direction-dependent part of dry friction (single-dof joints) [Nm or N].
/// @param direction of motion
inline double one_way_friction(const JointFrictionModel& friction, double direction) {
  return direction > 0.0 ? friction.forward : friction.backward;
}

}  // namespace anthrob
