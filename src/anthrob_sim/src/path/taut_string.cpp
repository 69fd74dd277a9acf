#include "path/taut_string.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace anthrob {

void TautString::reserve(int edges) {
  gates_.reserve(edges);
  crossings_.reserve(edges);
}

double TautString::pull(const GeodesicQuery& query, const std::vector<int>& edges) {
  if (!unfold(query, edges)) return std::numeric_limits<double>::infinity();
  crossings_.resize(gates_.size());
  if (!is_straight()) return pull_through_gates();
  cross_gates(source_, target_, 0, static_cast<int>(gates_.size()));
  return std::hypot(target_.x - source_.x, target_.y - source_.y);
}

bool TautString::unfold(const GeodesicQuery& query, const std::vector<int>& edges) {
  const ConvexHull& hull = query.hull;
  gates_.clear();
  Point origin{0.0, 0.0}, along{1.0, 0.0};
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const int h = edges[i];
    const ConvexHull::HalfEdge& e = hull.edge(h);
    if (i > 0) {
      const ConvexHull::HalfEdge& last = hull.edge(edges[i - 1]);
      const bool left = h == hull.left_exit(edges[i - 1]);
      const double cx = left ? last.left_x : last.right_x, cy = left ? last.left_y : last.right_y;
      if (!left) {
        origin = {origin.x + last.apex_x * along.x - last.apex_y * along.y,
                  origin.y + last.apex_x * along.y + last.apex_y * along.x};
      }
      along = {along.x * cx - along.y * cy, along.x * cy + along.y * cx};
    }
    Gate gate;
    const double c0 = query.clearance(hull.from(h)), c1 = query.clearance(hull.to(h));
    if (c0 <= 0.0 && c1 <= 0.0) return false;
    gate.lo_limited = c0 < 0.0;
    gate.hi_limited = c1 < 0.0;
    gate.lo = gate.lo_limited ? e.length * c0 / (c0 - c1) : 0.0;
    gate.hi = gate.hi_limited ? e.length * c0 / (c0 - c1) : e.length;
    gate.left = {origin.x + gate.lo * along.x, origin.y + gate.lo * along.y};
    gate.right = {origin.x + gate.hi * along.x, origin.y + gate.hi * along.y};
    gates_.push_back(gate);
  }
  const auto beside = [&](int h, const Vec3& p, double& x, double& y) {
    const Vec3 side = (hull.to(h) - hull.from(h)) * hull.edge(h).inverse_length;
    const Vec3 arm = p - hull.from(h);
    x = side.dot(arm);
    y = side.cross(arm).norm();
  };
  double x, y;
  beside(edges.front(), query.source, x, y);
  source_ = {x, -y};
  beside(edges.back(), query.target, x, y);
  target_ = {origin.x + x * along.x - y * along.y, origin.y + x * along.y + y * along.x};
  return true;
}

bool TautString::is_straight() {
  for (const Gate& gate : gates_) {
    if (turn(source_, target_, gate.left) < 0.0 || turn(source_, target_, gate.right) > 0.0) {
      return false;
    }
  }
  return true;
}

/// Where the segment from a to b meets the gates in [begin, end).
void TautString::cross_gates(const Point& a, const Point& b, int begin, int end) {
  for (int i = begin; i < end; ++i) {
    const Gate& gate = gates_[i];
    const double left = turn(a, b, gate.left), right = turn(a, b, gate.right);
    const double span = left - right;
    const double share = span > 0.0 ? std::clamp(left / span, 0.0, 1.0) : 0.5;
    crossings_[i] = {gate.lo + share * (gate.hi - gate.lo), Bend::kNone};
  }
}

/// The funnel: it narrows gate by gate; where it closes, the string bends.
double TautString::pull_through_gates() {
  const int count = static_cast<int>(gates_.size());
  Point apex = source_, left = source_, right = source_;
  int apex_gate = -1, left_gate = -1, right_gate = -1;
  double length = 0.0;
  const auto bend = [&](const Point& at, int gate, bool is_left) {
    cross_gates(apex, at, apex_gate + 1, gate);
    length += std::hypot(at.x - apex.x, at.y - apex.y);
    const Gate& g = gates_[gate];
    const bool limited = is_left ? g.lo_limited : g.hi_limited;
    crossings_[gate] = {is_left ? g.lo : g.hi, limited ? Bend::kAtLimit : Bend::kAtCorner};
    apex = left = right = at;
    apex_gate = left_gate = right_gate = gate;
  };
  for (int i = 0; i <= count; ++i) {
    const Point& l = i < count ? gates_[i].left : target_;
    const Point& r = i < count ? gates_[i].right : target_;
    if (right_gate == apex_gate || turn(apex, right, r) >= 0.0) {
      if (left_gate != apex_gate && turn(apex, left, r) > 0.0) {
        bend(Point(left), left_gate, true);
        i = apex_gate;
        continue;
      }
      right = r;
      right_gate = i;
    }
    if (left_gate == apex_gate || turn(apex, left, l) <= 0.0) {
      if (right_gate != apex_gate && turn(apex, right, l) < 0.0) {
        bend(Point(right), right_gate, false);
        i = apex_gate;
        continue;
      }
      left = l;
      left_gate = i;
    }
  }
  cross_gates(apex, target_, apex_gate + 1, count);
  return length + std::hypot(target_.x - apex.x, target_.y - apex.y);
}

}  // namespace anthrob
