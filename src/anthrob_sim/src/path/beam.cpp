#include "path/beam.h"

#include <algorithm>

namespace anthrob {

bool Beam::left_of_apex(const ConvexHull& hull, Beam& out) const {
  const ConvexHull::HalfEdge& e = hull.edge(edge);
  const double at = split(e);
  if (!point && a >= at) return false;
  const double cx = e.left_x, cy = e.left_y;
  out.edge = hull.left_exit(edge);
  out.point = false;
  out.sx = sx * cx + sy * cy;
  out.sy = std::min(0.0, sy * cx - sx * cy);
  const auto project = [&](double x) {
    const double px = x * cx, py = -x * cy, rise = py - out.sy;
    return rise > 0.0 ? out.sx - (px - out.sx) * out.sy / rise : px;
  };
  out.a = point ? 0.0 : std::clamp(project(a), 0.0, e.left_length);
  out.b = point || b >= at ? e.left_length : std::clamp(project(b), 0.0, e.left_length);
  return true;
}

bool Beam::right_of_apex(const ConvexHull& hull, Beam& out) const {
  const ConvexHull::HalfEdge& e = hull.edge(edge);
  const double at = split(e);
  if (!point && b <= at) return false;
  const double cx = e.right_x, cy = e.right_y;
  const double ux = sx - e.apex_x, uy = sy - e.apex_y;
  out.edge = hull.right_exit(edge);
  out.point = false;
  out.sx = ux * cx + uy * cy;
  out.sy = std::min(0.0, uy * cx - ux * cy);
  const auto project = [&](double x) {
    const double vx = x - e.apex_x, vy = -e.apex_y;
    const double px = vx * cx + vy * cy, rise = vy * cx - vx * cy - out.sy;
    return rise > 0.0 ? out.sx - (px - out.sx) * out.sy / rise : px;
  };
  out.a = point || a <= at ? 0.0 : std::clamp(project(a), 0.0, e.right_length);
  out.b = point ? e.right_length : std::clamp(project(b), 0.0, e.right_length);
  return true;
}

}  // namespace anthrob
