#pragma once

#include <Eigen/Core>
#include <vector>

#include "anthrob_control/control_settings.h"

namespace anthrob {

/// The torque that draws every joint to a posture: a bounded spring and a damper.
class PostureServo {
 public:
  PostureServo(const SkeletonModel& skeleton, const std::vector<JointGains>& gains);

  void reset() { integral_.setZero(); }

  /// Draws to `target`, with at most the joints' strength; an integral makes up for what the model
  /// does not know.
  const Eigen::VectorXd& track(const std::vector<double>& target, const Eigen::VectorXd& velocity,
                               const std::vector<double>& q, const Eigen::VectorXd& u, double dt);

  /// Holds `target` like dry friction would: who pushes harder than the joints' yield drags the
  /// target along. Without integral: with dry friction in the tendons it would hunt.
  const Eigen::VectorXd& hold(std::vector<double>& target, const std::vector<double>& q,
                              const Eigen::VectorXd& u);

 private:
  const SkeletonModel& skeleton_;
  std::vector<JointGains> gains_;
  Eigen::VectorXd error_, integral_, torque_;
};

}  // namespace anthrob
