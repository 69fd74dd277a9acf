#pragma once

#include <cstdint>
#include <vector>

#include "path/convex_hull.h"

namespace anthrob {

/// The border between the facets of a hull that a point lies above and those it does not.
class Horizon {
 public:
  void reserve(const ConvexHull& hull);

  /// Walks along the border from a half-edge on it: as many steps as the border has edges.
  /// @return false if `start` is not on it, or if the walk followed another closed line: rounding
  ///         can place a point in the plane of several facets above some and below others
  bool trace(const ConvexHull& hull, const Vec3& p, int start);

  /// Looks at all facets that p lies above, `facet` among them.
  void flood(const ConvexHull& hull, const Vec3& p, int facet);

  /// Half-edges through which the facets below the horizon are entered.
  const std::vector<int>& edges() const { return edges_; }

 private:
  std::vector<int> edges_, queue_;
  std::vector<std::uint64_t> seen_;
  std::uint64_t round_ = 0;
};

}  // namespace anthrob
