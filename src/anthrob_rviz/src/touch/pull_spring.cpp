#include "touch/pull_spring.h"

namespace anthrob {

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
