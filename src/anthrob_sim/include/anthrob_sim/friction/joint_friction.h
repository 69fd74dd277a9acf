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

}  // namespace anthrob
