#pragma once

#include "anthrob_reference/skeleton.h"

namespace anthrob::reference {

/// A law added to the equations of the joints: generalised torques on the skeleton. As with
/// MuscleLaw, only settle() changes the state of a law.
class JointLaw {
 public:
  virtual ~JointLaw() = default;

  virtual Vector4 torque(const JointState& state) const = 0;  ///< [Nm]
  /// -d torque / d velocity as far as it is stiff [Nms/rad].
  virtual Vector4 damping(const JointState& /*state*/) const { return Vector4::Zero(); }

  /// An integration step of h [s] has led to this state; the shoulder carries muscle forces and
  /// weight of `load` [N], humerus axes.
  virtual void settle(double /*h*/, const JointState& /*state*/, const Eigen::Vector3d& /*load*/) {}
};

}  // namespace anthrob::reference
