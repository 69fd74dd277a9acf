#pragma once

#include <vector>

#include "path/convex_hull.h"

namespace anthrob {

class DistanceField;

/// Two points outside a convex hull and the side on which the way between them may run: the
/// half-space through both points into which `up` shows.
struct GeodesicQuery {
  const ConvexHull& hull;
  Vec3 source = Vec3::Zero(), target = Vec3::Zero();  ///< [m]
  bool limited = false;
  Vec3 up = Vec3::UnitZ();               ///< unit, across the line from source to target
  const DistanceField* field = nullptr;  ///< distances from the target, if they are known

  /// Distance above the limit [m]; positive where the way may run.
  double clearance(const Vec3& p) const { return limited ? up.dot(p - source) : 1.0; }
  bool sees_source(int facet) const { return hull.height(facet, source) > 0.0; }
  bool sees_target(int facet) const { return hull.height(facet, target) > 0.0; }
};

/// The shortest way through a strip of facets: the strip is unfolded into the plane, and a string
/// is pulled taut in it. From the source to the first edge, and from the last edge to the target,
/// the way does not lie on the hull.
class TautString {
 public:
  enum class Bend : char { kNone, kAtLimit, kAtCorner };

  struct Crossing {
    double x = 0.0;  ///< along the half-edge [m]
    Bend bend = Bend::kNone;
  };

  void reserve(int edges);

  /// @param edges half-edges in the order in which the way enters their facets
  /// @return its length [m]; infinite if the limit closes the strip
  double pull(const GeodesicQuery& query, const std::vector<int>& edges);

  /// Crossings of the last pull, one for each edge.
  const std::vector<Crossing>& crossings() const { return crossings_; }

 private:
  struct Point {
    double x, y;
  };
  struct Gate {
    Point left, right;
    double lo, hi;  ///< the part of the edge that is open [m]
    bool lo_limited, hi_limited;
  };

  bool unfold(const GeodesicQuery& query, const std::vector<int>& edges);
  bool is_straight();
  double pull_through_gates();
  void cross_gates(const Point& a, const Point& b, int begin, int end);
  static double turn(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  }

  Point source_{}, target_{};
  std::vector<Gate> gates_;
  std::vector<Crossing> crossings_;
};

}  // namespace anthrob
