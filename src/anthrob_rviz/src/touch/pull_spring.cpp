#include "touch/pull_spring.h"

#include <algorithm>

namespace anthrob {

PullSpring softened(const PullSpring& spring, double period) {
  constexpr double kOften = 0.006;  // [s] from here on the delay counts
  const double share = std::min(1.0, kOften / std::max(period, kOften));
  return {spring.stiffness * share * share, spring.damping * share, spring.limit};
}

void RenewalPeriod::renewed(double time) {
  const double period = time - last_;
  last_ = time;
  if (period > 0.0 && period < kPause) mean_ += kWeight * (period - mean_);
}

Pull pull_of(const PullSpring& spring, const Vec3& grabbed_W, const Vec3& velocity_W,
             const Vec3& mouse_W) {
  Pull pull;
  pull.force_W = spring.stiffness * (mouse_W - grabbed_W) - spring.damping * velocity_W;
  const double size = pull.force_W.norm();
  pull.limited = size > spring.limit;
  if (pull.limited) pull.force_W *= spring.limit / size;
  return pull;
}

}  // namespace anthrob
