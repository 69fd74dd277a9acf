#include "path/hull_geodesic.h"

#include <algorithm>
#include <limits>

namespace anthrob {

namespace {

/// The middle of the part of an edge that the limit leaves open.
Vec3 middle(const GeodesicQuery& query, int h) {
  const Vec3 &a = query.hull.from(h), &b = query.hull.to(h);
  const double ca = query.clearance(a), cb = query.clearance(b);
  double lo = 0.0, hi = 1.0;
  if (ca < 0.0 && cb > 0.0) lo = ca / (ca - cb);
  if (cb < 0.0 && ca > 0.0) hi = ca / (ca - cb);
  return a + 0.5 * (lo + hi) * (b - a);
}

}  // namespace

void HullGeodesic::reserve(const ConvexHull& hull) {
  search_.reserve(hull);
  rim_.reserve(hull);
  string_.reserve(hull.half_edge_count());
  walked_.reserve(hull.half_edge_count());
}

HullGeodesic::Outcome HullGeodesic::solve(const GeodesicQuery& query, int facet,
                                          std::vector<int>& strip) {
  Outcome outcome = Outcome::kConfirmed;
  const bool fits = fit(query, strip);
  if (!fits || !rim_.trace(query.hull, query.source, strip.front())) {
    rim_.flood(query.hull, query.source, facet);
  }
  if (!fits) {
    outcome = Outcome::kCold;
    cut(query, strip);
  }
  length_ = strip.empty() ? std::numeric_limits<double>::infinity() : string_.pull(query, strip);
  search_.run(query, rim_.edges(), length_);
  if (!search_.strip().empty()) {
    if (outcome == Outcome::kConfirmed) outcome = Outcome::kImproved;
    strip = search_.strip();
    length_ = string_.pull(query, strip);
  }
  return outcome;
}

/// Shortens or extends a strip so that it runs from the source's rim to the target's.
bool HullGeodesic::fit(const GeodesicQuery& query, std::vector<int>& strip) {
  const ConvexHull& hull = query.hull;
  if (strip.empty()) return false;
  const auto before = [&](int h) { return ConvexHull::facet_of(hull.edge(h).twin); };
  int begin = -1, end = static_cast<int>(strip.size());
  for (int i = 0; i < end; ++i) {
    if (query.sees_source(before(strip[i]))) begin = i;
  }
  for (int i = end - 1; i >= std::max(begin, 0); --i) {
    if (query.sees_target(ConvexHull::facet_of(strip[i]))) end = i + 1;
  }
  strip.resize(end);
  strip.erase(strip.begin(), strip.begin() + std::max(begin, 0));
  if (begin < 0) {
    const int first = hull.edge(strip.front()).twin;
    if (!walk(query, middle(query, first), true, first)) return false;
    for (const int h : walked_) strip.insert(strip.begin(), hull.edge(h).twin);
  }
  if (!query.sees_target(ConvexHull::facet_of(strip.back()))) {
    if (!walk(query, middle(query, strip.back()), false, strip.back())) return false;
    strip.insert(strip.end(), walked_.begin(), walked_.end());
  }
  return true;
}

/// A first strip: the section of the hull along `up`.
bool HullGeodesic::cut(const GeodesicQuery& query, std::vector<int>& strip) {
  const ConvexHull& hull = query.hull;
  strip.clear();
  const Vec3 line = query.target - query.source;
  const Vec3 up = query.limited ? query.up : Vec3(line.unitOrthogonal());
  const Vec3 side = up.cross(line);
  for (const int h : rim_.edges()) {
    const double a = side.dot(hull.from(h) - query.source);
    const double b = side.dot(hull.to(h) - query.source);
    if ((a < 0.0) == (b < 0.0)) continue;
    const Vec3 x = hull.from(h) + a / (a - b) * (hull.to(h) - hull.from(h));
    if (up.dot(x - query.source) <= 0.0) continue;
    strip.push_back(h);
    if (query.sees_target(ConvexHull::facet_of(h))) return true;
    if (walk(query, x, false, h)) {
      strip.insert(strip.end(), walked_.begin(), walked_.end());
      return true;
    }
    strip.clear();
  }
  return false;
}

/// From an edge in the plane through the two points and `through`, over the facet it enters and on,
/// until a facet is reached that the source (the target) lies above. Edges crossed: `walked_`.
bool HullGeodesic::walk(const GeodesicQuery& query, const Vec3& through, bool to_source, int from) {
  const ConvexHull& hull = query.hull;
  const Vec3 plane = (through - query.source).cross(query.target - query.source);
  const auto side = [&](const Vec3& p) { return plane.dot(p - query.source); };
  walked_.clear();
  int h = from;
  for (int i = 0; i < hull.facet_count(); ++i) {
    const int facet = ConvexHull::facet_of(h);
    if (to_source ? query.sees_source(facet) : query.sees_target(facet)) return true;
    const bool start_side = side(hull.from(h)) < 0.0;
    const bool apex_side = side(hull.vertices()[hull.edge(h).apex]) < 0.0;
    h = apex_side == start_side ? hull.right_exit(h) : hull.left_exit(h);
    walked_.push_back(h);
  }
  return false;
}

}  // namespace anthrob
