#include "path/selected_mesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace anthrob {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Geodesic =
    CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;

Vec3 vec(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

Point point(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

/// Frame F of (4.36), with the succeeding point as origin.
struct Frame {
  Frame(const Vec3& before, const Vec3& after, const Vec3& chi) {
    span = (before - after).norm();
    x = (before - after) / span;
    z = chi - chi.dot(x) * x;
  }
  double span;
  Vec3 x, z;  ///< z of any length
};

Mesh::Vertex_index find(const Mesh& mesh, const Point& p) {
  for (const auto v : mesh.vertices()) {
    if (mesh.point(v) == p) return v;
  }
  return Mesh::null_vertex();
}

/// (4.41): what faces downwards is no surface to run over.
void keep_upper_side(Mesh& mesh, const Vec3& up) {
  std::vector<Mesh::Face_index> lower;
  for (const auto f : mesh.faces()) {
    Vec3 corner[3];
    int i = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      corner[i++] = vec(mesh.point(v));
    }
    if ((corner[1] - corner[0]).cross(corner[2] - corner[0]).dot(up) <= 0.0) lower.push_back(f);
  }
  for (const auto f : lower) CGAL::Euler::remove_face(mesh.halfedge(f), mesh);
  mesh.collect_garbage();
}

/// The upper side of the hull of both path points and the selected vertices.
Mesh envelope(const Point& p, const Point& q, const std::vector<Vec3>& vertices,
              const std::vector<int>& selected, const Vec3& up) {
  std::vector<Point> input = {p, q};
  for (const int v : selected) input.push_back(point(vertices[v]));
  Mesh mesh;
  CGAL::convex_hull_3(input.begin(), input.end(), mesh);
  if (mesh.number_of_faces() >= 4) keep_upper_side(mesh, up);
  return mesh;
}

}  // namespace

SelectedMesh::SelectedMesh(std::vector<Vec3> vertices_B, const Vec3& chi_B,
                           std::vector<std::string> remarks)
    : vertices_(std::move(vertices_B)), chi_(chi_B.normalized()), remarks_(std::move(remarks)) {
  if (vertices_.size() < 4) throw std::invalid_argument("a mesh needs four vertices");
}

std::vector<int> SelectedMesh::selection(const Vec3& before, const Vec3& after) const {
  const Frame frame(before, after, chi_);
  std::vector<int> selected;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vec3 v = vertices_[i] - after;
    if (v.dot(frame.z) > 0.0 && v.dot(frame.x) > 0.0) selected.push_back(static_cast<int>(i));
  }
  return selected;
}

/// g_1 ... g_n of (4.42); two points where the tendon is straight.
std::vector<Vec3> SelectedMesh::way(const Vec3& before, const Vec3& after) const {
  const std::vector<Vec3> straight = {before, after};
  const Frame frame(before, after, chi_);
  if (!(frame.span > 0.0) || frame.z.norm() < 1e-9) return straight;
  std::vector<int> selected = selection(before, after);
  const Point p = point(before), q = point(after);
  Mesh mesh = envelope(p, q, vertices_, selected, frame.z);
  if (find(mesh, p) == Mesh::null_vertex()) {
    const auto beyond = [&](int v) { return (vertices_[v] - after).dot(frame.x) >= frame.span; };
    selected.erase(std::remove_if(selected.begin(), selected.end(), beyond), selected.end());
    mesh = envelope(p, q, vertices_, selected, frame.z);
  }
  const auto from = find(mesh, p), to = find(mesh, q);
  if (mesh.number_of_faces() == 0 || from == Mesh::null_vertex() || to == Mesh::null_vertex() ||
      mesh.halfedge(from, to) != Mesh::null_halfedge()) {
    return straight;
  }
  Geodesic geodesic(mesh);
  geodesic.add_source_point(to);
  std::vector<Point> found;
  geodesic.shortest_path_points_to_source_points(from, std::back_inserter(found));
  std::vector<Vec3> points;
  for (const Point& g : found) {
    if (points.empty() || (vec(g) - points.back()).norm() > 1e-12) points.push_back(vec(g));
  }
  return points.size() < 2 ? straight : points;
}

void SelectedMesh::wrap(const Vec3& before, const Vec3& after, StateView,
                        WrapContact& contact) const {
  const std::vector<Vec3> g = way(before, after);
  const std::size_t n = g.size();
  if (n == 2) {
    set_straight(before, after, vertices_.front(), contact);
    return;
  }
  contact = WrapContact();
  contact.touching = true;
  contact.entry = g[1];
  contact.exit = g[n - 2];
  contact.length_in = (g[1] - g[0]).norm();
  contact.length_out = (g[n - 1] - g[n - 2]).norm();
  contact.direction_in = contact.pull_in = (g[1] - g[0]) / contact.length_in;
  contact.direction_out = contact.pull_out = (g[n - 1] - g[n - 2]) / contact.length_out;
  Vec3 direction = contact.direction_in;
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vec3 piece = g[i + 1] - g[i];
    const double length = piece.norm();
    if (i + 2 < n) contact.length_on += length;
    const Vec3 ahead = piece / length;
    contact.turning += 2.0 * std::asin(std::min(1.0, 0.5 * (ahead - direction).norm()));
    direction = ahead;
  }
  contact.wrap_angle = contact.turning;
  contact.half_turns = static_cast<int>(contact.turning / M_PI);
}

void SelectedMesh::trace(const WrapContact& contact, std::vector<Vec3>& points) const {
  const Vec3 before = contact.entry - contact.length_in * contact.direction_in;
  const Vec3 after = contact.exit + contact.length_out * contact.direction_out;
  const std::vector<Vec3> g = way(before, after);
  points.insert(points.end(), g.begin() + 1, g.end() - 1);
}

}  // namespace anthrob
