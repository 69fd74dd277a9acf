#pragma once

#include "anthrob_sim/path/convex_hull.h"

namespace anthrob {

/// A path point as the geodesic sees it: where it is, or, if it lies inside the hull, moved to the
/// surface along the line from the hull's core.
struct HullPoint {
  Vec3 p = Vec3::Zero();  ///< outside the hull [m]
  int facet = 0;          ///< which p lies above; the one that the line from the core leaves by
  double depth = 0.0;     ///< [m] inside; 0 outside
  bool moved = false;

  /// Gradient with respect to the original point, from that with respect to p.
  Vec3 pull_back(const Vec3& gradient) const;

  Vec3 arm = Vec3::Zero();        ///< from the core to the original point; of a moved one
  Vec3 core_axis = Vec3::Zero();  ///< unit along which the core's point follows; zero at its ends
  double gain = 1.0;              ///< p - core over arm
  Vec3 normal = Vec3::Zero();
};

/// Questions to a convex polyhedron that are answered by walking over it from a first guess.
///
/// Seen from a point of the core, facets are vertices of the polar body, on which "which facet does
/// this ray leave by" is a linear programme: climbing to better neighbours ends at the best.
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
