#include "anthrob_control/posture_motion.h"

#include <algorithm>
#include <stdexcept>

#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {

PostureMotion::PostureMotion(const SkeletonModel& skeleton) : skeleton_(skeleton) {
  way_ = u_ = a_ = Eigen::VectorXd::Zero(skeleton.velocity_count);
  stand(skeleton.rest_configuration());
}

void PostureMotion::stand(const std::vector<double>& q) {
  from_ = to_ = q_ = q;
  way_.setZero(), u_.setZero(), a_.setZero();
  duration_ = time_ = 0.0;
}

void PostureMotion::start(const std::vector<double>& from, const std::vector<double>& to,
                          double duration) {
  if (!(duration > 0.0)) throw std::invalid_argument("PostureMotion: duration: expected > 0 s");
  stand(from);
  to_ = to;
  duration_ = duration;
  posture_difference(skeleton_, from, to, way_);
}

void PostureMotion::advance(double dt) {
  time_ = std::min(duration_, time_ + dt);
  if (arrived()) {
    stand(to_);
    return;
  }
  // Flash and Hogan's polynomial. A ball joint turns about one axis, which stays the same in the
  // child's axes.
  const double s = time_ / duration_;
  const double share = s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
  const double speed = 30.0 * s * s * (1.0 - s) * (1.0 - s) / duration_;
  const double gain = 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) / (duration_ * duration_);
  posture_between(skeleton_, from_, to_, share, q_);
  u_ = speed * way_;
  a_ = gain * way_;
}

}  // namespace anthrob
