#include "labelling/motion_prior.h"

namespace anthrob {
namespace mocap {

namespace {

// How far two estimates of a target at rest can lie apart.
constexpr double kAngleNoise = 0.03;      // [rad]
constexpr double kPositionNoise = 0.003;  // [m]

}  // namespace

bool MotionPrior::near(double t, const Pose& X) const {
  const double dt = t - t_;
  return angular_distance(X.R, X_.R) <= kAngleNoise + options_.max_turn_rate * dt &&
         (X * centre_ - X_ * centre_).norm() <= kPositionNoise + options_.max_speed * dt;
}

void MotionPrior::accept(double t, const Pose& X) {
  streak_ = recent(t) && near(t, X) ? streak_ + 1 : 0;
  known_ = true;
  t_ = t, X_ = X;
}

}  // namespace mocap
}  // namespace anthrob
