#pragma once

#include "laws/laws.h"

namespace anthrob::virtual_robot {

// Things that no entry of the effect catalogue describes; one file each, listed in
// outside_laws.cpp.
HiddenLaw command_slew();
HiddenLaw elbow_microphone();
HiddenLaw force_compression();
HiddenLaw gusts();
HiddenLaw motor_induction();
HiddenLaw one_bad_tooth();
HiddenLaw periodic_push();
HiddenLaw quadratic_drag();
HiddenLaw shoulder_hardening();
HiddenLaw slipping_knot();
HiddenLaw stale_samples();
HiddenLaw sticking_with_age();
HiddenLaw torque_ripple();
HiddenLaw warming_ring();
HiddenLaw weak_above_angle();

/// A generalised torque on one joint.
inline reference::Vector4 on_joint(const std::string& place, const Eigen::Vector3d& shoulder,
                                   double elbow) {
  reference::Vector4 torque = reference::Vector4::Zero();
  if (is_shoulder(place)) {
    torque.head<3>() = shoulder;
  } else {
    torque(3) = elbow;
  }
  return torque;
}

}  // namespace anthrob::virtual_robot
