#pragma once

#include "path/convex_hull.h"

namespace anthrob {

/// A path point as the geodesic sees it: where it is, or, if it lies inside the hull, moved to the
/// surface along the line from the hull's core.
struct HullPoint {
  Vec3 p = Vec3::Zero();  ///< outside the hull [m]
  int facet = 0;          ///< a facet that p lies above; the line from the core leaves through it
  double depth = 0.0;     ///< [m] inside; 0 outside
  bool moved = false;

  /// Gradient with respect to the original point, from that with respect to p.
  Vec3 pull_back(const Vec3& gradient) const;

  Vec3 arm = Vec3::Zero();        ///< from the core to the original point, if moved
  Vec3 core_axis = Vec3::Zero();  ///< unit, of motion of the core's point; zero at the core's ends
  double gain = 1.0;              ///< of p - core, relative to `arm`
  Vec3 normal = Vec3::Zero();
};

/// Queries on a convex polyhedron, answered by walking over its facets from a first guess.
///
/// In the polar body about a point of the core, facets become vertices. There the facet through
/// which a ray leaves is the solution of a linear programme: moving to better neighbours ends at
/// it.
class HullLocator {
 public:
  explicit HullLocator(const ConvexHull& hull) : hull_(hull) {}

  /// @param hint any facet; the last answer makes it quick
  HullPoint locate(const Vec3& p, int hint) const;

  /// Whether the open segment from a point outside enters the inside.
  /// @param facet one that `a` lies above; becomes the one through which the segment would enter
  bool segment_enters(const Vec3& a, const Vec3& b, int& facet) const;

  /// A moved point is lifted by this, so that every point the geodesic sees is outside.
  double lift() const { return 1e-8 * hull_.size(); }

 private:
  int climb(const Vec3& core, const Vec3& arm, int facet) const;
  int scan(const Vec3& core, const Vec3& arm) const;

  const ConvexHull& hull_;
};

}  // namespace anthrob
