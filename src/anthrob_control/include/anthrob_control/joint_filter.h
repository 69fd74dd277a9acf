#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {

/// First-order low-pass filters on measured joint positions and velocities. Orientations of ball
/// joints are filtered along the rotation between them. The first sample passes unchanged.
class JointFilter {
 public:
  /// @param position_cutoff, velocity_cutoff [Hz], > 0
  JointFilter(const SkeletonModel& skeleton, double position_cutoff, double velocity_cutoff)
      : skeleton_(skeleton),
        position_cutoff_(position_cutoff),
        velocity_cutoff_(velocity_cutoff),
        q_(skeleton.rest_configuration()),
        u_(Eigen::VectorXd::Zero(skeleton.velocity_count)),
        change_(u_) {}

  void reset() { fresh_ = true; }

  /// @param dt since the last sample [s]
  void step(const std::vector<double>& q, const Eigen::VectorXd& u, double dt) {
    if (fresh_) {
      q_ = q, u_ = u, fresh_ = false;
      return;
    }
    posture_difference(skeleton_, q_, q, change_);
    change_ *= share(position_cutoff_, dt);
    posture_plus(skeleton_, q_, change_, q_);
    u_ += share(velocity_cutoff_, dt) * (u - u_);
  }

  const std::vector<double>& configuration() const { return q_; }
  const Eigen::VectorXd& velocity() const { return u_; }

 private:
  /// Exact for a signal that is constant between samples.
  static double share(double cutoff, double dt) {
    constexpr double kTwoPi = 2.0 * M_PI;
    return -std::expm1(-kTwoPi * cutoff * dt);
  }

  const SkeletonModel& skeleton_;
  double position_cutoff_, velocity_cutoff_;
  std::vector<double> q_;
  Eigen::VectorXd u_, change_;
  bool fresh_ = true;
};

}  // namespace anthrob
