#pragma once

#include "anthrob_sim/path/wrapping_surface.h"

namespace anthrob {

/// A bone's mesh as the thesis wraps on it, to the letter of (4.39)-(4.45): in each posture those
/// vertices of the mesh are taken that lie in a half-space, and the tendon is the shortest way over
/// the upper side of the convex hull of these and of both path points.
///
/// With P and Q the path points, x from Q to P and z = chi made orthogonal to x (4.36):
///   (4.39)  selected: (v - Q) . z > 0  and  (v - Q) . x > 0, besides P and Q
///   (4.41)  upper side: facets whose normal n has n . z > 0.
/// (4.39) prints P and Q absolute beside vertices relative to Q; all are taken relative to Q. Where
/// the bone reaches beyond P, so that P would lie below the hull and not on its upper side, as the
/// thesis takes for granted, vertices beyond P are left out as well.
///
/// When a vertex enters or leaves the half-space the hull changes at once, and with it the tendon's
/// length and direction. MeshSurface is what the robots use; this one shows the difference. It
/// builds hull and geodesic anew each time: milliseconds.
class SelectedMesh final : public WrappingSurface {
 public:
  SelectedMesh(std::vector<Vec3> vertices_B, const Vec3& chi_B,
               std::vector<std::string> remarks = {});

  std::string type() const override { return "mesh"; }
  std::size_t state_size() const override { return 0; }
  void initialise(const Vec3&, const Vec3&, StateView) const override {}
  void wrap(const Vec3& before, const Vec3& after, StateView state,
            WrapContact& contact) const override;
  void trace(const WrapContact& contact, std::vector<Vec3>& points) const override;
  std::vector<std::string> remarks() const override { return remarks_; }

  /// The vertices that (4.39) takes.
  std::vector<int> selection(const Vec3& before, const Vec3& after) const;
  const std::vector<Vec3>& vertices() const { return vertices_; }

 private:
  std::vector<Vec3> way(const Vec3& before, const Vec3& after) const;

  std::vector<Vec3> vertices_;
  Vec3 chi_;
  std::vector<std::string> remarks_;
};

}  // namespace anthrob
