#pragma once

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "path/mesh_surface.h"
#include "support.h"

namespace anthrob {
namespace testing_support {

/// Corners of an icosahedron refined by halving its sides, on the unit sphere.
inline std::vector<Vec3> icosphere(int halvings) {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vec3> points;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-g, g}) {
      for (const Vec3& p : {Vec3(0, a, b), Vec3(a, b, 0), Vec3(b, 0, a)}) {
        points.push_back(p.normalized());
      }
    }
  }
  double side = 4.0 / std::sqrt(10.0 + 2.0 * std::sqrt(5.0));  // of the icosahedron
  std::vector<std::array<int, 3>> facets;
  for (int i = 0; i < 12; ++i) {
    for (int j = i + 1; j < 12; ++j) {
      for (int k = j + 1; k < 12; ++k) {
        const auto near = [&](int a, int b) { return (points[a] - points[b]).norm() < 1.1 * side; };
        if (near(i, j) && near(j, k) && near(k, i)) facets.push_back({i, j, k});
      }
    }
  }
  for (int round = 0; round < halvings; ++round) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto key = std::make_pair(std::min(a, b), std::max(a, b));
      const auto it = middles.find(key);
      if (it != middles.end()) return it->second;
      points.push_back((points[a] + points[b]).normalized());
      return middles[key] = static_cast<int>(points.size()) - 1;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : facets) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.push_back({a, ab, ca});
      finer.push_back({b, bc, ab});
      finer.push_back({c, ca, bc});
      finer.push_back({ab, bc, ca});
    }
    facets = finer;
  }
  return points;
}

/// A prism of `sides` sides round y: flat ends of many triangles in one plane.
inline std::vector<Vec3> prism(int sides, double radius, double half_height) {
  std::vector<Vec3> points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * M_PI * (i + 0.5) / sides;
    for (const double y : {-half_height, half_height}) {
      points.emplace_back(radius * std::sin(angle), y, radius * std::cos(angle));
    }
  }
  return points;
}

/// Bodies of 6 to 600 points: ellipsoids, boxes with points on their faces, dented ones.
inline std::vector<Vec3> random_body(Random& random) {
  const int count = random.integer(6, random.integer(0, 3) == 0 ? 600 : 120);
  const Vec3 radii(random.uniform(0.005, 0.05), random.uniform(0.005, 0.05),
                   random.uniform(0.005, 0.05));
  const double dents = random.integer(0, 1) ? random.uniform(0.0, 0.4) : 0.0;
  const bool box = random.integer(0, 4) == 0;
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    Vec3 d = random.direction();
    if (box) d /= d.cwiseAbs().maxCoeff();
    points.push_back((1.0 - dents * random.uniform(0.0, 1.0)) * radii.cwiseProduct(d));
  }
  return points;
}

/// A point within 0.1 m outside the hull, now and then just over its surface.
inline Vec3 random_outside(Random& random, const MeshSurface& surface) {
  const HullLocator locator(surface.hull());
  for (;;) {
    const Vec3 p = random.uniform(0.02, 0.1) * random.direction();
    const HullPoint found = locator.locate(p, 0);
    if (!found.moved) return p;
    if (random.integer(0, 2) == 0) return found.p + 1e-5 * found.normal;
  }
}

}  // namespace testing_support
}  // namespace anthrob
