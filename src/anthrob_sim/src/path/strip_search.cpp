#include "anthrob_sim/path/strip_search.h"

#include <algorithm>
#include <cmath>

namespace anthrob {

namespace {
/// Ways shorter by less than this share of the hull's size are the same.
constexpr double kSame = 1e-9;

/// Length of the shortest way from (sx, sy <= 0) over [a, b] of the x axis to a point `up` away
/// from the axis.
double over_edge(double sx, double sy, double tx, double up, double a, double b) {
  const double rise = up - sy, run = tx - sx;
  // Where the straight line crosses, times rise: the division waits until it is needed.
  const double cross = sx * up - tx * sy;
  if (cross >= a * rise && cross <= b * rise) return std::sqrt(run * run + rise * rise);
  const double x = cross < a * rise ? a : b;
  return std::sqrt((x - sx) * (x - sx) + sy * sy) + std::sqrt((tx - x) * (tx - x) + up * up);
}
}  // namespace

void StripSearch::reserve(const ConvexHull& hull) {
  const std::size_t edges = hull.half_edge_count();
  if (label_.size() < edges) {
    label_.resize(edges);
    label_run_.resize(edges, 0);
    chain_.resize(edges + 1);
    strip_.reserve(edges + 1);
    stack_.reserve(4 * edges);
  }
}

double StripSearch::run(const GeodesicQuery& query, const std::vector<int>& rim, double bound) {
  const ConvexHull& hull = query.hull;
  ++run_;
  windows_ = 0;
  strip_.clear();
  stack_.clear();
  best_ = bound;
  worthwhile_ = bound - kSame * hull.size();
  for (const int h : rim) {
    const ConvexHull::HalfEdge& e = hull.edge(h);
    const Vec3 side = (hull.to(h) - hull.from(h)) * e.inverse_length;
    const Vec3 arm = query.source - hull.from(h);
    Window w{};
    w.edge = h;
    w.b = e.length;
    w.sx = side.dot(arm);
    w.sy = -side.cross(arm).norm();
    w.clear0 = query.clearance(hull.from(h));
    w.clear1 = query.clearance(hull.to(h));
    w.far0 = (query.target - hull.from(h)).squaredNorm();
    w.far1 = (query.target - hull.to(h)).squaredNorm();
    consider(query, w);
  }
  // Best first among the first windows, then depth first: the bound drops early.
  std::sort(stack_.begin(), stack_.end(),
            [](const Window& a, const Window& b) { return a.least > b.least; });
  while (!stack_.empty()) {
    const Window window = stack_.back();
    stack_.pop_back();
    if (window.least >= worthwhile_) continue;
    chain_[window.depth] = window.edge;
    carry_on(query, window);
  }
  return best_;
}

/// Cuts a window to the limit and keeps it if it may lead to a shorter way.
void StripSearch::consider(const GeodesicQuery& query, Window& w) {
  ++windows_;
  const ConvexHull::HalfEdge& e = query.hull.edge(w.edge);
  const bool low = w.clear0 < 0.0, high = w.clear1 < 0.0;
  double limit = -1.0;
  if (low || high) {
    if (w.clear0 <= 0.0 && w.clear1 <= 0.0) return;
    limit = e.length * w.clear0 / (w.clear0 - w.clear1);
    const bool inside = limit >= w.a && limit <= w.b;
    if (low) w.a = std::max(w.a, limit);
    if (high) w.b = std::min(w.b, limit);
    if (w.a > w.b) return;
    if (!inside) limit = -1.0;
  }
  const double tx = 0.5 * ((w.far0 - w.far1) * e.inverse_length + e.length);
  const double up = std::sqrt(std::max(0.0, w.far0 - tx * tx));
  w.least = w.before + over_edge(w.sx, w.sy, tx, up, w.a, w.b);
  if (w.least >= worthwhile_) return;
  if (query.sees_target(ConvexHull::facet_of(w.edge))) {
    keep_if_better(w, w.least);
    return;
  }
  stack_.push_back(w);
  if (limit >= 0.0) open_point(w, limit, std::hypot(tx - limit, up));
}

void StripSearch::open_point(const Window& from, double x, double remaining) {
  const double reached = from.before + std::hypot(x - from.sx, from.sy);
  if (reached + remaining >= worthwhile_) return;
  if (label_run_[from.edge] == run_ && reached >= label_[from.edge]) return;
  label_run_[from.edge] = run_;
  label_[from.edge] = reached;
  Window point = from;
  point.point = true;
  point.a = point.b = point.sx = x;
  point.sy = 0.0;
  point.before = reached;
  point.least = reached + remaining;
  stack_.push_back(point);
}

void StripSearch::keep_if_better(const Window& w, double length) {
  if (length >= worthwhile_) return;
  best_ = worthwhile_ = length;
  strip_.assign(chain_.begin(), chain_.begin() + w.depth);
  strip_.push_back(w.edge);
}

/// Through the facet behind the window's edge, to its two other edges.
void StripSearch::carry_on(const GeodesicQuery& query, const Window& w) {
  const ConvexHull& hull = query.hull;
  const ConvexHull::HalfEdge& e = hull.edge(w.edge);
  const Vec3& apex = hull.vertices()[e.apex];
  const double clear = query.clearance(apex), far = (query.target - apex).squaredNorm();
  // Where the line from the source to the apex crosses the edge.
  const double split = w.sx - (e.apex_x - w.sx) * w.sy / (e.apex_y - w.sy);

  Window child = w;
  child.depth = w.depth + 1;
  if (child.depth >= static_cast<int>(chain_.size())) return;
  child.point = false;
  Window first = child;
  bool has_first = false;
  if (w.point || w.a < split) {  // the edge from the start to the apex
    child.edge = hull.left_exit(w.edge);
    const double cx = e.left_x, cy = e.left_y;
    child.sx = w.sx * cx + w.sy * cy;
    child.sy = std::min(0.0, w.sy * cx - w.sx * cy);
    const auto project = [&](double x) {
      const double px = x * cx, py = -x * cy, rise = py - child.sy;
      return rise > 0.0 ? child.sx - (px - child.sx) * child.sy / rise : px;
    };
    child.a = w.point ? 0.0 : std::clamp(project(w.a), 0.0, e.left_length);
    child.b =
        w.point || w.b >= split ? e.left_length : std::clamp(project(w.b), 0.0, e.left_length);
    child.clear1 = clear;
    child.far1 = far;
    first = child;
    has_first = true;
  }
  if (w.point || w.b > split) {  // the edge from the apex to the end
    child.edge = hull.right_exit(w.edge);
    const double cx = e.right_x, cy = e.right_y;
    const double ux = w.sx - e.apex_x, uy = w.sy - e.apex_y;
    child.sx = ux * cx + uy * cy;
    child.sy = std::min(0.0, uy * cx - ux * cy);
    const auto project = [&](double x) {
      const double vx = x - e.apex_x, vy = -e.apex_y;
      const double px = vx * cx + vy * cy, rise = vy * cx - vx * cy - child.sy;
      return rise > 0.0 ? child.sx - (px - child.sx) * child.sy / rise : px;
    };
    child.a = w.point || w.a <= split ? 0.0 : std::clamp(project(w.a), 0.0, e.right_length);
    child.b = w.point ? e.right_length : std::clamp(project(w.b), 0.0, e.right_length);
    child.clear0 = clear;
    child.clear1 = w.clear1;
    child.far0 = far;
    child.far1 = w.far1;
    consider(query, child);
  }
  if (has_first) consider(query, first);
}

}  // namespace anthrob
