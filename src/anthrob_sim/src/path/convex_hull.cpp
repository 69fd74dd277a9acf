#include "path/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>

namespace anthrob {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Facets = std::vector<std::array<int, 3>>;

double diagonal(const std::vector<Vec3>& points) {
  Vec3 lo = points.front(), hi = points.front();
  for (const Vec3& p : points) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
  return (hi - lo).norm();
}

/// Vertices and facets in an order of their own: CGAL's follows from where things lie in memory,
/// and with it the rounding of all that is computed from them.
void sort(std::vector<Vec3>& points, Facets& facets) {
  std::vector<int> order(points.size()), place(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::lexicographical_compare(points[a].data(), points[a].data() + 3, points[b].data(),
                                        points[b].data() + 3);
  });
  std::vector<Vec3> sorted;
  for (std::size_t i = 0; i < order.size(); ++i) {
    sorted.push_back(points[order[i]]);
    place[order[i]] = static_cast<int>(i);
  }
  points.swap(sorted);
  for (auto& facet : facets) {
    for (int& corner : facet) corner = place[corner];
    std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
  }
  std::sort(facets.begin(), facets.end());
}

/// Facets of the hull; `points` is reduced to its vertices.
Facets hull_of(std::vector<Vec3>& points) {
  std::vector<Kernel::Point_3> input;
  for (const Vec3& p : points) input.emplace_back(p.x(), p.y(), p.z());
  CGAL::Surface_mesh<Kernel::Point_3> mesh;
  CGAL::convex_hull_3(input.begin(), input.end(), mesh);
  Facets facets;
  if (mesh.number_of_faces() < 4) return facets;
  points.clear();
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    points.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : mesh.faces()) {
    std::array<int, 3> corners{};
    int i = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      corners[i++] = static_cast<int>(v);
    }
    facets.push_back(corners);
  }
  sort(points, facets);
  return facets;
}

/// The middle corner of a facet that is thinner than `least`, or -1.
int needless_corner(const std::vector<Vec3>& points, const std::array<int, 3>& facet,
                    double least) {
  const Vec3 &a = points[facet[0]], &b = points[facet[1]], &c = points[facet[2]];
  const double sides[3] = {(c - b).norm(), (a - c).norm(), (b - a).norm()};
  const int longest = static_cast<int>(std::max_element(sides, sides + 3) - sides);
  const double altitude = (b - a).cross(c - a).norm() / sides[longest];
  return altitude < least ? facet[longest] : -1;
}

}  // namespace

ConvexHull::ConvexHull(std::vector<Vec3> points) {
  const auto flat = [] { return std::invalid_argument("the hull of the points has no volume"); };
  if (points.size() < 4) throw flat();
  size_ = diagonal(points);
  for (;;) {
    const Facets facets = hull_of(points);
    if (facets.empty()) throw flat();
    std::set<int> needless;
    for (const auto& facet : facets) {
      const int corner = needless_corner(points, facet, kSliver * size_);
      // One corner a facet and no two neighbours at once: what is left out stays near what is kept.
      const bool alone = corner >= 0 && !needless.count(facet[0]) && !needless.count(facet[1]) &&
                         !needless.count(facet[2]);
      if (alone) needless.insert(corner);
    }
    if (needless.empty()) {
      vertices_ = points;
      connect(facets);
      break;
    }
    for (auto it = needless.rbegin(); it != needless.rend(); ++it) {
      points.erase(points.begin() + *it);
    }
    if (points.size() < 4) throw flat();
  }
  lay_out();
  place_core();
}

void ConvexHull::connect(const Facets& facets) {
  std::map<std::pair<int, int>, int> sides;
  edges_.resize(3 * facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const int h = static_cast<int>(3 * f) + i;
      edges_[h].from = facets[f][i];
      edges_[h].apex = facets[f][(i + 2) % 3];
      sides[{facets[f][i], facets[f][(i + 1) % 3]}] = h;
    }
  }
  for (const auto& [ends, h] : sides) edges_[h].twin = sides.at({ends.second, ends.first});
}

void ConvexHull::lay_out() {
  for (int h = 0; h < half_edge_count(); ++h) {
    HalfEdge& e = edges_[h];
    const Vec3 side = to(h) - from(h), apex = vertices_[e.apex] - from(h);
    e.length = side.norm();
    e.inverse_length = 1.0 / e.length;
    e.apex_x = apex.dot(side) / e.length;
    e.apex_y = apex.cross(side).norm() / e.length;
    e.left_length = apex.norm();
    e.left_x = e.apex_x / e.left_length;
    e.left_y = e.apex_y / e.left_length;
    const double dx = e.length - e.apex_x;
    e.right_length = std::hypot(dx, e.apex_y);
    e.right_x = dx / e.right_length;
    e.right_y = -e.apex_y / e.right_length;
    if (h % 3 != 0) continue;
    normals_.push_back(side.cross(apex).normalized());
    offsets_.push_back(normals_.back().dot(from(h)));
  }
}

void ConvexHull::place_core() {
  // Volume, centroid and second moments as sums over tetrahedra from one corner.
  const Vec3 origin = vertices_.front();
  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (int f = 0; f < facet_count(); ++f) {
    const Vec3 a = from(3 * f) - origin, b = from(3 * f + 1) - origin, c = from(3 * f + 2) - origin;
    const double v = a.dot(b.cross(c)) / 6.0;
    const Vec3 sum = a + b + c;
    volume += v;
    first += v / 4.0 * sum;
    second += v / 20.0 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  if (!(volume > 1e-12 * std::pow(size_, 3))) {
    throw std::invalid_argument("the hull of the points has no volume");
  }
  const Vec3 mean = first / volume;
  const Mat3 spread = second / volume - mean * mean.transpose();
  const Vec3 axis = Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors().col(2);
  const Vec3 centroid = origin + mean;
  // The chord along the longest axis, kept away from its ends by the distance to the sides.
  double back = size_, ahead = size_, depth = size_;
  for (int f = 0; f < facet_count(); ++f) {
    const double below = -height(f, centroid), slope = normals_[f].dot(axis);
    depth = std::min(depth, below);
    if (slope > 1e-12) ahead = std::min(ahead, below / slope);
    if (slope < -1e-12) back = std::min(back, -below / slope);
  }
  core_[0] = centroid - std::max(0.0, back - depth) * axis;
  core_[1] = centroid + std::max(0.0, ahead - depth) * axis;
}

}  // namespace anthrob
