#pragma once

#include <cmath>

#include "path/convex_hull.h"

namespace anthrob {

/// Straight lines from one source that pass a stretch of an edge, unfolded into the plane of the
/// facet behind it.
struct Beam {
  int edge = 0;           ///< half-edge; its frame is that of all numbers here
  double a = 0, b = 0;    ///< the stretch [m]
  double sx = 0, sy = 0;  ///< the source, sy <= 0
  bool point = false;     ///< the source is the point a = b of the edge: all directions are open

  /// The part of the beam that leaves the facet between the edge's start and the apex.
  /// @return false if there is none
  bool left_of_apex(const ConvexHull& hull, Beam& out) const;
  /// The part of the beam that leaves the facet between the apex and the edge's end.
  bool right_of_apex(const ConvexHull& hull, Beam& out) const;

  /// Length of the shortest way from the source over the stretch to a point `up` >= 0 beyond the
  /// edge's line.
  double length_to(double x, double up) const { return length_to(x, up, a, b); }
  /// The same over [lo, hi].
  double length_to(double x, double up, double lo, double hi) const {
    const double rise = up - sy, run = x - sx;
    // Position at which the straight line crosses the edge, times `rise`: avoids a division.
    const double cross = sx * up - x * sy;
    if (cross >= lo * rise && cross <= hi * rise) return std::sqrt(run * run + rise * rise);
    const double at = cross < lo * rise ? lo : hi;
    return std::sqrt((at - sx) * (at - sx) + sy * sy) + std::sqrt((x - at) * (x - at) + up * up);
  }

 private:
  /// Where the line from the source to the apex crosses the edge.
  double split(const ConvexHull::HalfEdge& e) const {
    return sx - (e.apex_x - sx) * sy / (e.apex_y - sy);
  }
};

}  // namespace anthrob
