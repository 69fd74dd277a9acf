#pragma once

#include <vector>

#include "path/beam.h"

namespace anthrob {

/// Lengths of the shortest ways from one point to every point of a convex hull's edges. If a path
/// point is fixed to the bone, they can be computed before the motion.
///
/// Each edge divides into stretches, each of which sees the unfolded point through one strip of
/// facets. To find them, beams are carried over the hull, shortest first; where two beams reach the
/// same stretch, the shorter one keeps it. On a convex body no shortest way passes a corner, so all
/// ways start at the point itself, and two of them are equally long at one place of an edge at
/// most.
class DistanceField {
 public:
  /// @param from outside the hull    @param facet one that it lies above
  DistanceField(const ConvexHull& hull, const Vec3& from, int facet);

  const Vec3& from() const { return from_; }

  /// Length of the shortest way from a beam's source over its edge to the point, if the beam met no
  /// obstacle [m].
  double beyond(const Beam& beam) const;

 private:
  /// Up to `end` the point, unfolded, is at (x, y >= 0) in the frame of the half-edge.
  struct Piece {
    double end, x, y;
  };
  friend class DistanceFieldBuilder;

  Vec3 from_;
  std::vector<Piece> pieces_;
  std::vector<int> first_;  ///< of each half-edge; one more at the end
};

}  // namespace anthrob
