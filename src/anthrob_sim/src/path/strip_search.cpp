#include "path/strip_search.h"

#include <algorithm>
#include <cmath>

#include "path/distance_field.h"

namespace anthrob {

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
  ++run_;
  strip_.clear();
  stack_.clear();
  best_ = bound;
  worthwhile_ = bound - kSame * query.hull.size();
  for (const int h : rim) enter(query, h);
  // Best first among the first windows, then depth first: the bound drops early.
  std::sort(stack_.begin(), stack_.end(),
            [](const Window& a, const Window& b) { return a.least > b.least; });
  while (!stack_.empty()) {
    const Window window = stack_.back();
    stack_.pop_back();
    if (window.least >= worthwhile_) continue;
    chain_[window.depth] = window.beam.edge;
    carry_on(query, window);
  }
  return best_;
}

/// Over an edge of the source's horizon.
void StripSearch::enter(const GeodesicQuery& query, int h) {
  const ConvexHull& hull = query.hull;
  const double clear0 = query.clearance(hull.from(h)), clear1 = query.clearance(hull.to(h));
  if (clear0 <= 0.0 && clear1 <= 0.0) return;
  const ConvexHull::HalfEdge& e = hull.edge(h);
  const Vec3 side = (hull.to(h) - hull.from(h)) * e.inverse_length;
  const Vec3 arm = query.source - hull.from(h);
  Window w{};
  w.beam = {h, 0.0, e.length, side.dot(arm), -side.cross(arm).norm(), false};
  w.clear0 = clear0;
  w.clear1 = clear1;
  w.far0 = (query.target - hull.from(h)).squaredNorm();
  w.far1 = (query.target - hull.to(h)).squaredNorm();
  consider(query, w);
}

/// Cuts a window to the limit and keeps it if it may lead to a shorter way.
void StripSearch::consider(const GeodesicQuery& query, Window& w) {
  Beam& beam = w.beam;
  const bool low = w.clear0 < 0.0, high = w.clear1 < 0.0;
  double limit = -1.0;
  if (low || high) {
    if (w.clear0 <= 0.0 && w.clear1 <= 0.0) return;
    limit = query.hull.edge(beam.edge).length * w.clear0 / (w.clear0 - w.clear1);
    const bool inside = limit >= beam.a && limit <= beam.b;
    if (low) beam.a = std::max(beam.a, limit);
    if (high) beam.b = std::min(beam.b, limit);
    if (beam.a > beam.b) return;
    if (!inside) limit = -1.0;
  }
  w.least = w.before + (query.field ? query.field->beyond(beam) : through_air(query, w));
  if (w.least >= worthwhile_) return;
  if (query.sees_target(ConvexHull::facet_of(beam.edge))) {
    keep_if_better(w, w.before + through_air(query, w));
    return;
  }
  stack_.push_back(w);
  if (limit >= 0.0) open_point(query, w, limit);
}

/// From the beam's source over the edge, then straight to the target.
double StripSearch::through_air(const GeodesicQuery& query, const Window& w) const {
  const ConvexHull::HalfEdge& e = query.hull.edge(w.beam.edge);
  const double x = 0.5 * ((w.far0 - w.far1) * e.inverse_length + e.length);
  return w.beam.length_to(x, std::sqrt(std::max(0.0, w.far0 - x * x)));
}

void StripSearch::open_point(const GeodesicQuery& query, const Window& from, double x) {
  const int edge = from.beam.edge;
  const double reached = from.before + std::hypot(x - from.beam.sx, from.beam.sy);
  if (label_run_[edge] == run_ && reached >= label_[edge]) return;
  Window point = from;
  point.beam = {edge, x, x, x, 0.0, true};
  point.before = reached;
  point.least =
      reached + (query.field ? query.field->beyond(point.beam) : through_air(query, point));
  if (point.least >= worthwhile_) return;
  label_run_[edge] = run_;
  label_[edge] = reached;
  stack_.push_back(point);
}

void StripSearch::keep_if_better(const Window& w, double length) {
  if (length >= worthwhile_) return;
  best_ = worthwhile_ = length;
  strip_.assign(chain_.begin(), chain_.begin() + w.depth);
  strip_.push_back(w.beam.edge);
}

/// Through the facet behind the window's edge, to its two other edges.
void StripSearch::carry_on(const GeodesicQuery& query, const Window& w) {
  const Vec3& apex = query.hull.vertices()[query.hull.edge(w.beam.edge).apex];
  const double clear = query.clearance(apex), far = (query.target - apex).squaredNorm();
  Window left = w;
  left.depth = w.depth + 1;
  if (left.depth >= static_cast<int>(chain_.size())) return;
  Window right = left;
  if (w.beam.right_of_apex(query.hull, right.beam)) {
    right.clear0 = clear;
    right.far0 = far;
    consider(query, right);
  }
  if (w.beam.left_of_apex(query.hull, left.beam)) {
    left.clear1 = clear;
    left.far1 = far;
    consider(query, left);
  }
}

}  // namespace anthrob
