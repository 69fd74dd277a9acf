#pragma once

#include <array>
#include <vector>

#include "anthrob_core/pose.h"

namespace anthrob {

/// A convex polyhedron of triangles, prepared for unfolding: half-edge 3f+i runs along side i of
/// facet f, anticlockwise seen from outside. Immutable.
///
/// Each half-edge carries its facet laid into the plane: origin at its start, x along it, y into
/// the facet.
class ConvexHull {
 public:
  struct HalfEdge {
    int twin;        ///< the same side, of the neighbouring facet
    int from, apex;  ///< vertices: start, and the corner opposite
    double length, inverse_length;
    double apex_x, apex_y;
    double left_x, left_y;    ///< unit, from the start to the apex
    double right_x, right_y;  ///< unit, from the apex to the end
    double left_length, right_length;
  };

  /// @param points at least four, not in one plane [m]
  /// Vertices that change the hull by less than kSliver are left out: no facet is too thin for a
  /// sound normal.
  /// @throws std::invalid_argument if the hull is flat
  explicit ConvexHull(std::vector<Vec3> points);

  static constexpr double kSliver = 1e-7;  ///< share of the size

  int facet_count() const { return static_cast<int>(normals_.size()); }
  int half_edge_count() const { return static_cast<int>(edges_.size()); }
  const std::vector<Vec3>& vertices() const { return vertices_; }
  const HalfEdge& edge(int h) const { return edges_[h]; }
  const Vec3& from(int h) const { return vertices_[edges_[h].from]; }
  const Vec3& to(int h) const { return vertices_[edges_[next(h)].from]; }

  static int facet_of(int h) { return h / 3; }
  static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static int previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
  /// Half-edges through which one leaves the facet entered at h, seen from the facet beyond.
  int left_exit(int h) const { return edges_[previous(h)].twin; }
  int right_exit(int h) const { return edges_[next(h)].twin; }

  const Vec3& normal(int facet) const { return normals_[facet]; }  ///< unit, outwards
  /// Of a point over the plane of a facet; negative below [m].
  double height(int facet, const Vec3& p) const { return normals_[facet].dot(p) - offsets_[facet]; }

  double size() const { return size_; }                ///< diagonal of the bounding box [m]
  const Vec3& core_begin() const { return core_[0]; }  ///< ends of a line well inside, see Locator
  const Vec3& core_end() const { return core_[1]; }

 private:
  void connect(const std::vector<std::array<int, 3>>& facets);
  void lay_out();
  void place_core();

  std::vector<Vec3> vertices_;
  std::vector<HalfEdge> edges_;
  std::vector<Vec3> normals_;
  std::vector<double> offsets_;
  double size_ = 0.0;
  Vec3 core_[2];
};

}  // namespace anthrob
