#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "anthrob_reference/arm.h"

namespace anthrob::virtual_robot {

/// A posture, and the co-contraction of the muscles there.
struct Pose {
  Eigen::Vector3d shoulder = Eigen::Vector3d::Zero();  ///< rotation vector from rest, humerus axes
  double elbow = 0.0;                                  ///< [rad]
  double lowest_tension = 1.0;                         ///< least tension of any muscle [N]
};

Eigen::Quaterniond rotation(const Eigen::Vector3d& vector);
Pose blend(const Pose& a, const Pose& b, double share);

/// Tensions f with the least sum of squares for which A f = torque and f >= lowest; if there are
/// none, those with the nearest torque. Newton's method on the dual problem.
Eigen::VectorXd least_effort(const Eigen::MatrixXd& A, const Eigen::VectorXd& torque,
                             double lowest);

/// Actuator positions at which an arm of these parameters rests in a pose, without friction.
class PostureReference final {
 public:
  explicit PostureReference(const reference::ArmParameters& parameters);

  std::vector<double> positions(const Pose& pose);

 private:
  reference::ArmParameters parameters_;
  reference::Skeleton skeleton_;
  reference::Arm arm_;
};

}  // namespace anthrob::virtual_robot
