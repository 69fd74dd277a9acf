#pragma once

#include <Eigen/Core>
#include <vector>

#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {

/// Minimum-jerk motion from one posture to another on the shortest way, at rest at both ends.
class PostureMotion {
 public:
  static constexpr double kFastest = 1.875;  ///< highest speed divided by mean speed

  explicit PostureMotion(const SkeletonModel& skeleton);

  /// Stands still at a posture.
  void stand(const std::vector<double>& q);
  /// @param duration [s], > 0
  void start(const std::vector<double>& from, const std::vector<double>& to, double duration);
  void advance(double dt);

  bool arrived() const { return time_ >= duration_; }
  const std::vector<double>& configuration() const { return q_; }
  /// Ball joints in the child's axes.
  const Eigen::VectorXd& velocity() const { return u_; }
  const Eigen::VectorXd& acceleration() const { return a_; }

 private:
  const SkeletonModel& skeleton_;
  std::vector<double> from_, to_, q_;
  Eigen::VectorXd way_, u_, a_;
  double duration_ = 0.0, time_ = 0.0;
};

}  // namespace anthrob
