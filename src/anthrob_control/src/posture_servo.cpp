#include "anthrob_control/posture_servo.h"

#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {

PostureServo::PostureServo(const SkeletonModel& skeleton, const std::vector<JointGains>& gains)
    : skeleton_(skeleton), gains_(gains) {
  error_ = integral_ = torque_ = Eigen::VectorXd::Zero(skeleton.velocity_count);
}

const Eigen::VectorXd& PostureServo::track(const std::vector<double>& target,
                                           const Eigen::VectorXd& velocity,
                                           const std::vector<double>& q, const Eigen::VectorXd& u,
                                           double dt) {
  posture_difference(skeleton_, q, target, error_);
  for (std::size_t j = 0; j < gains_.size(); ++j) {
    const int at = skeleton_.joints[j].velocity_offset, dof = skeleton_.joints[j].dof();
    auto torque = torque_.segment(at, dof);
    auto integral = integral_.segment(at, dof);
    torque = gains_[j].stiffness * error_.segment(at, dof) + integral;
    const double size = torque.norm();
    if (size > gains_[j].strength) {
      torque *= gains_[j].strength / size;
    } else {
      // The integral stands still while the torque is bounded: no wind-up.
      integral += gains_[j].integral * dt * error_.segment(at, dof);
    }
    torque += gains_[j].damping * (velocity - u).segment(at, dof);
  }
  return torque_;
}

const Eigen::VectorXd& PostureServo::hold(std::vector<double>& target, const std::vector<double>& q,
                                          const Eigen::VectorXd& u) {
  posture_difference(skeleton_, q, target, error_);
  for (std::size_t j = 0; j < gains_.size(); ++j) {
    const int at = skeleton_.joints[j].velocity_offset, dof = skeleton_.joints[j].dof();
    auto error = error_.segment(at, dof);
    const double size = gains_[j].stiffness * error.norm();
    if (size > gains_[j].yield) error *= gains_[j].yield / size;
    torque_.segment(at, dof) = gains_[j].stiffness * error - gains_[j].damping * u.segment(at, dof);
  }
  posture_plus(skeleton_, q, error_, target);
  return torque_;
}

}  // namespace anthrob
