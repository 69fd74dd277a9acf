#include "path/hull_locator.h"

#include <algorithm>
#include <cmath>

namespace anthrob {

namespace {
/// Deeper than half the way the model is wrong anyway; forces must stay bounded.
constexpr double kMaxGain = 2.0;
constexpr double kEqual = 1e-10;
}  // namespace

Vec3 HullPoint::pull_back(const Vec3& gradient) const {
  if (!moved) return gradient;
  // p = core + gain * arm; the core's point follows along its axis, the arm covers the rest.
  const auto along = [&](const Vec3& v) { return Vec3(core_axis * core_axis.dot(v)); };
  const double g = std::min(gain, kMaxGain);
  const Vec3 side = gradient - along(gradient);
  const Vec3 slope = along(normal) + g * (normal - along(normal));
  return along(gradient) + g * side - slope * (arm.dot(gradient) / arm.dot(normal));
}

HullPoint HullLocator::locate(const Vec3& p, int hint) const {
  HullPoint result;
  result.p = p;
  const Vec3 line = hull_.core_end() - hull_.core_begin();
  const double span = line.norm();
  Vec3 core = hull_.core_begin();
  if (span > 0.0) {
    const Vec3 axis = line / span;
    const double s = axis.dot(p - core);
    if (s > 0.0 && s < span) result.core_axis = axis;
    core += std::clamp(s, 0.0, span) * axis;
  }
  Vec3 arm = p - core;
  const bool central = arm.norm() < kEqual * hull_.size();
  if (central) arm = kEqual * hull_.size() * (span > 0.0 ? line.unitOrthogonal() : Vec3::UnitX());
  result.facet = climb(core, arm, hint);
  const double height = hull_.height(result.facet, p);
  if (height >= lift()) return result;

  result.moved = true;
  result.depth = std::max(0.0, -height);
  result.arm = arm;
  result.normal = hull_.normal(result.facet);
  result.gain = -hull_.height(result.facet, core) / result.normal.dot(arm);
  result.p = core + result.gain * arm + lift() * result.normal;
  return result;
}

int HullLocator::climb(const Vec3& core, const Vec3& arm, int facet) const {
  const auto value = [&](int f) { return hull_.normal(f).dot(arm) / -hull_.height(f, core); };
  const double same = kEqual * arm.norm() / hull_.size();
  double best = value(facet);
  const auto try_neighbours = [&](int of, int& better) {
    for (int h = 3 * of; h < 3 * of + 3; ++h) {
      const int f = ConvexHull::facet_of(hull_.edge(h).twin);
      const double v = value(f);
      if (v > best) best = v, better = f;
    }
  };
  for (;;) {
    int better = -1;
    try_neighbours(facet, better);
    // Triangles of one plane hide what lies beyond their plane's rim: look over the whole plate.
    constexpr int kCapacity = 64;
    int plate[kCapacity], count = 1;
    plate[0] = facet;
    for (int i = 0; i < count && better < 0; ++i) {
      for (int h = 3 * plate[i]; h < 3 * plate[i] + 3; ++h) {
        const int f = ConvexHull::facet_of(hull_.edge(h).twin);
        if (value(f) < best - same || std::find(plate, plate + count, f) != plate + count) continue;
        if (count == kCapacity) return scan(core, arm);
        plate[count++] = f;
        try_neighbours(f, better);
      }
    }
    if (better < 0) return facet;
    facet = better;
  }
}

int HullLocator::scan(const Vec3& core, const Vec3& arm) const {
  int best = 0;
  double most = -1.0;
  for (int f = 0; f < hull_.facet_count(); ++f) {
    const double value = hull_.normal(f).dot(arm) / -hull_.height(f, core);
    if (value > most) most = value, best = f;
  }
  return best;
}

bool HullLocator::segment_enters(const Vec3& a, const Vec3& b, int& facet) const {
  const Vec3 ray = b - a;
  // In central projection from a the facets below it tile a convex region: walk towards the ray.
  for (int steps = 0; steps <= hull_.facet_count(); ++steps) {
    int out = -1;
    double worst = 0.0;
    for (int h = 3 * facet; h < 3 * facet + 3; ++h) {
      const double side = ray.dot((hull_.to(h) - a).cross(hull_.from(h) - a));
      if (side < worst) worst = side, out = h;
    }
    if (out < 0) return hull_.height(facet, b) < 0.0;
    const int beyond = ConvexHull::facet_of(hull_.edge(out).twin);
    if (hull_.height(beyond, a) <= 0.0) return false;
    facet = beyond;
  }
  return true;
}

}  // namespace anthrob
