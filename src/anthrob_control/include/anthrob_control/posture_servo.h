#pragma once

#include <Eigen/Core>
#include <vector>

#include "anthrob_control/control_settings.h"

namespace anthrob {

/// The torque that drives every joint towards a posture: a bounded spring and a damper.
class PostureServo {
 public:
  PostureServo(const SkeletonModel& skeleton, const std::vector<JointGains>& gains);

  void reset() { integral_.setZero(); }

  /// Torque towards `target`. Spring and integral together have at most the joint's `strength`;
  /// damping is added to them. The integral compensates errors of the model.
  /// @param target, q of size position_count, the other vectors of size velocity_count
  /// @return torques [Nm]
  const Eigen::VectorXd& track(const std::vector<double>& target, const Eigen::VectorXd& velocity,
                               const std::vector<double>& q, const Eigen::VectorXd& u, double dt);

  /// Torque that holds `target` as dry friction would: a push beyond the joint's `yield` drags
  /// `target` along. Has no integral, with which dry friction in the tendons would cause hunting.
  const Eigen::VectorXd& hold(std::vector<double>& target, const std::vector<double>& q,
                              const Eigen::VectorXd& u);

 private:
  const SkeletonModel& skeleton_;
  std::vector<JointGains> gains_;
  Eigen::VectorXd error_, integral_, torque_;
};

}  // namespace anthrob
