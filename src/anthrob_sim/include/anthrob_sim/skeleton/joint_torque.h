#pragma once

#include <vector>

#include "anthrob_sim/skeleton/kinematic_tree.h"

namespace anthrob {

/// A posture-dependent joint torque, such as that of a spring.
class JointTorque {
 public:
  virtual ~JointTorque() = default;
  /// Adds to generalised forces, ball joints in world axes [Nm, N].
  /// @param q joint positions
  virtual void add(const KinematicTree& tree, const std::vector<double>& q, double* tau) const = 0;
  /// Its potential energy [J].
  virtual double energy(const std::vector<double>& q) const = 0;
};

}  // namespace anthrob
