#pragma once

#include <array>
#include <vector>

#include "anthrob_core/pose.h"

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

/// The same over the upper side of the hull of p, q and those vertices above the plane across chi
/// and on p's side of q: (4.39)-(4.45). No way over the upper side: not wrapped.
/// @param facets if given: corners of the upper side's facets, in order
ReferenceWay reference_way_over_selection(const std::vector<Vec3>& vertices, const Vec3& p,
                                          const Vec3& q, const Vec3& chi,
                                          std::vector<std::array<Vec3, 3>>* facets = nullptr);

}  // namespace testing_support
}  // namespace anthrob
