#include "mesh_reference.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>
#include <CGAL/convex_hull_3.h>

#include <cmath>

namespace anthrob {
namespace testing_support {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Geodesic =
    CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;

Vec3 vec(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

Mesh hull(const std::vector<Vec3>& points) {
  std::vector<Point> input;
  for (const Vec3& p : points) input.emplace_back(p.x(), p.y(), p.z());
  Mesh mesh;
  CGAL::convex_hull_3(input.begin(), input.end(), mesh);
  return mesh;
}

/// Whether the open segment cuts the inside: clipped by every facet's plane.
bool cuts(const Mesh& mesh, const Vec3& p, const Vec3& q) {
  double enter = 0.0, leave = 1.0;
  for (const auto f : mesh.faces()) {
    Vec3 corner[3];
    int i = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      corner[i++] = vec(mesh.point(v));
    }
    const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    const double a = normal.dot(p - corner[0]), b = normal.dot(q - corner[0]);
    if (a >= 0.0 && b >= 0.0) return false;
    if (a > 0.0) enter = std::max(enter, a / (a - b));
    if (b > 0.0) leave = std::min(leave, a / (a - b));
  }
  return enter < leave;
}

/// What of the solid lies above the plane through p across `up`, as points.
std::vector<Vec3> upper_part(const Mesh& mesh, const Vec3& p, const Vec3& up) {
  std::vector<Vec3> kept;
  for (const auto v : mesh.vertices()) {
    if (up.dot(vec(mesh.point(v)) - p) > 0.0) kept.push_back(vec(mesh.point(v)));
  }
  for (const auto e : mesh.edges()) {
    const Vec3 a = vec(mesh.point(mesh.vertex(e, 0))), b = vec(mesh.point(mesh.vertex(e, 1)));
    const double ha = up.dot(a - p), hb = up.dot(b - p);
    if ((ha > 0.0) == (hb > 0.0)) continue;
    Vec3 x = a + ha / (ha - hb) * (b - a);
    x -= up * up.dot(x - p);
    kept.push_back(x);
  }
  return kept;
}

/// Opens the hull at the plane: what lies in it is no surface to run over.
void remove_floor(Mesh& mesh, const Vec3& p, const Vec3& up) {
  std::vector<Mesh::Face_index> floor;
  for (const auto f : mesh.faces()) {
    bool in_plane = true;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      in_plane = in_plane && std::abs(up.dot(vec(mesh.point(v)) - p)) < 1e-12;
    }
    if (in_plane) floor.push_back(f);
  }
  for (const auto f : floor) CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
  mesh.collect_garbage();
}

Mesh::Vertex_index nearest(const Mesh& mesh, const Vec3& p) {
  auto best = *mesh.vertices().begin();
  for (const auto v : mesh.vertices()) {
    if ((vec(mesh.point(v)) - p).squaredNorm() < (vec(mesh.point(best)) - p).squaredNorm())
      best = v;
  }
  return best;
}

/// Fills in the shortest way over a mesh that has p and q among its vertices.
void take_shortest(const Mesh& mesh, const Vec3& p, const Vec3& q, ReferenceWay& way) {
  Geodesic geodesic(mesh);
  geodesic.add_source_point(nearest(mesh, q));
  std::vector<Point> way_points;
  way.length =
      geodesic
          .shortest_path_points_to_source_points(nearest(mesh, p), std::back_inserter(way_points))
          .first;
  const auto direction = [&](std::size_t from, int step) {
    for (std::size_t i = from + step; i < way_points.size(); i += step) {
      const Vec3 piece = vec(way_points[i]) - vec(way_points[from]);
      if (piece.norm() > 1e-9) return Vec3(piece.normalized());
    }
    return Vec3(Vec3::Zero());
  };
  way.direction_in = direction(0, 1);
  way.direction_out = -direction(way_points.size() - 1, -1);
}

}  // namespace

ReferenceWay reference_way(const std::vector<Vec3>& points, const Vec3& p, const Vec3& q,
                           const Vec3& chi) {
  ReferenceWay way;
  const Vec3 line = q - p;
  way.length = line.norm();
  way.direction_in = way.direction_out = line / way.length;
  const Mesh bone = hull(points);
  way.wraps = cuts(bone, p, q);
  if (!way.wraps) return way;

  const Vec3 across = chi - chi.dot(line) / line.squaredNorm() * line;
  const bool limited = across.norm() > 1e-9;
  const Vec3 up = limited ? Vec3(across.normalized()) : Vec3(Vec3::Zero());
  std::vector<Vec3> around;
  if (limited) {
    around = upper_part(bone, p, up);
  } else {
    for (const auto v : bone.vertices()) around.push_back(vec(bone.point(v)));
  }
  around.push_back(p);
  around.push_back(q);
  Mesh mesh = hull(around);
  if (limited) remove_floor(mesh, p, up);

  take_shortest(mesh, p, q, way);
  return way;
}

ReferenceWay reference_way_over_selection(const std::vector<Vec3>& vertices, const Vec3& p,
                                          const Vec3& q, const Vec3& chi,
                                          std::vector<std::array<Vec3, 3>>* facets) {
  ReferenceWay way;
  const Vec3 line = q - p;
  way.length = line.norm();
  way.direction_in = way.direction_out = line / way.length;
  const Vec3 up = line.cross(chi.cross(line));
  std::vector<Vec3> around = {p, q};
  for (const Vec3& v : vertices) {
    if (up.dot(v - q) > 0.0 && line.dot(v - q) < 0.0) around.push_back(v);
  }
  Mesh mesh = hull(around);
  std::vector<Mesh::Face_index> lower;
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const Vec3 a = vec(mesh.point(mesh.source(h))), b = vec(mesh.point(mesh.target(h)));
    const Vec3 c = vec(mesh.point(mesh.target(mesh.next(h))));
    if ((b - a).cross(c - b).dot(up) <= 0.0) {
      lower.push_back(f);
    } else if (facets != nullptr) {
      facets->push_back({a, b, c});
    }
  }
  for (const auto f : lower) CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
  mesh.collect_garbage();
  const auto from = nearest(mesh, p), to = nearest(mesh, q);
  way.wraps = mesh.number_of_faces() > 1 && vec(mesh.point(from)) == p &&
              vec(mesh.point(to)) == q && !mesh.halfedge(from, to).is_valid();
  if (way.wraps) take_shortest(mesh, p, q, way);
  return way;
}

}  // namespace testing_support
}  // namespace anthrob
