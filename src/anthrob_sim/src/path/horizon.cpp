#include "path/horizon.h"

namespace anthrob {

namespace {

bool sees(const ConvexHull& hull, const Vec3& p, int facet) {
  return hull.height(facet, p) > 0.0;
}

/// Counts how often a closed walk round a line, seen along it, passes one side of the line.
class Winding {
 public:
  Winding(const Vec3& origin, const Vec3& along)
      : origin_(origin), x_(along.unitOrthogonal()), y_(along.cross(x_)) {}

  void pass(const Vec3& point) {
    const Vec3 arm = point - origin_;
    const double x = x_.dot(arm), y = y_.dot(arm);
    const bool above = y > 0.0;
    if (started_ && above != above_ && (x * last_y_ - last_x_ * y) * (last_y_ - y) > 0.0) ++count_;
    started_ = true;
    above_ = above, last_x_ = x, last_y_ = y;
  }
  bool goes_round() const { return count_ % 2 == 1; }

 private:
  const Vec3 origin_, x_, y_;
  bool started_ = false, above_ = false;
  double last_x_ = 0.0, last_y_ = 0.0;
  int count_ = 0;
};

}  // namespace

void Horizon::reserve(const ConvexHull& hull) {
  const std::size_t edges = hull.half_edge_count();
  if (seen_.size() >= edges) return;
  seen_.resize(edges, 0);
  edges_.reserve(edges);
  queue_.reserve(edges);
}

bool Horizon::trace(const ConvexHull& hull, const Vec3& p, int start) {
  const auto beyond_is_seen = [&](int h) {
    return sees(hull, p, ConvexHull::facet_of(hull.edge(h).twin));
  };
  edges_.clear();
  if (sees(hull, p, ConvexHull::facet_of(start)) || !beyond_is_seen(start)) return false;
  // The true horizon encloses every interior point.
  Winding winding(p, hull.core_begin() - p);
  winding.pass(hull.from(start));
  int h = start;
  do {
    edges_.push_back(h);
    // Round the corner at its end, from facet to facet below the horizon.
    h = ConvexHull::next(h);
    while (!beyond_is_seen(h)) h = ConvexHull::next(hull.edge(h).twin);
    winding.pass(hull.from(h));
  } while (h != start && edges_.size() < seen_.size());
  return h == start && winding.goes_round();
}

void Horizon::flood(const ConvexHull& hull, const Vec3& p, int facet) {
  ++round_;
  edges_.clear();
  queue_.assign(1, facet);
  seen_[facet] = round_;
  for (std::size_t i = 0; i < queue_.size(); ++i) {
    for (int h = 3 * queue_[i]; h < 3 * queue_[i] + 3; ++h) {
      const int twin = hull.edge(h).twin, beyond = ConvexHull::facet_of(twin);
      if (seen_[beyond] == round_) continue;
      if (sees(hull, p, beyond)) {
        seen_[beyond] = round_;
        queue_.push_back(beyond);
      } else {
        edges_.push_back(twin);
      }
    }
  }
}

}  // namespace anthrob
