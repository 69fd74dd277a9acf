#pragma once

#include <cstdint>
#include <vector>

#include "anthrob_core/pose.h"

namespace anthrob {

/// Triangles, counter-clockwise seen from outside.
struct TubeMesh {
  std::vector<Vec3> positions;  ///< [m]; the first and the last are the middles of its ends
  std::vector<Vec3> normals;    ///< unit, by position
  std::vector<std::uint32_t> indices;
  bool empty() const { return positions.empty(); }
};

/// A tube about the line through points, closed by flat ends whose middles are the first and the
/// last point. Points that lie in one place count once. At a bend the pieces are mitred: both keep
/// their radius. Where the line turns back by more than 120 degrees a mitre would be a spike, and
/// the pieces end straight.
/// @param radius > 0 [m]
/// @param sides >= 3
/// @return empty if there are not two different points
TubeMesh tube(const std::vector<Vec3>& points, double radius, int sides);

}  // namespace anthrob
