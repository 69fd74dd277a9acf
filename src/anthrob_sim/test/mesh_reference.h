#pragma once

#include <vector>

#include "anthrob_sim/core/types.h"

namespace anthrob {
namespace testing_support {

struct ReferenceWay {
  bool wraps = false;
  double length = 0.0;               ///< [m]
  Vec3 direction_in, direction_out;  ///< unit; at the first and the last point
};

/// The shortest way from p to q round the convex hull of `points`, on the side of `chi` (zero:
/// any), by other people's means: CGAL cuts nothing short, warm-starts nothing and knows nothing of
/// unfolded strips from the step before.
ReferenceWay reference_way(const std::vector<Vec3>& points, const Vec3& p, const Vec3& q,
                           const Vec3& chi);

}  // namespace testing_support
}  // namespace anthrob
