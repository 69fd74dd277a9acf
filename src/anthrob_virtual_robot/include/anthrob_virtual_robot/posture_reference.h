#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "anthrob_reference/arm.h"

namespace anthrob::virtual_robot {

/// Where the joints should be, and how hard the muscles pull against each other there.
struct Pose {
  Eigen::Vector3d shoulder = Eigen::Vector3d::Zero();  ///< rotation vector from rest, humerus axes
  double elbow = 0.0;                                  ///< [rad]
  double lowest_tension = 1.0;                         ///< of any muscle [N]
};

Eigen::Quaterniond rotation(const Eigen::Vector3d& vector);
Pose blend(const Pose& a, const Pose& b, double share);

/// Least sum of squares of f with A f = torque and f >= lowest; where that cannot be, the nearest
/// torque. Newton's method on the dual.
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
