#pragma once

#include <mutex>

#include "anthrob_sim/path/wrapping_surface.h"
#include "path/convex_hull.h"
#include "path/distance_field.h"
#include "path/hull_geodesic.h"
#include "path/hull_locator.h"
#include "path/mesh_file.h"

namespace anthrob {

/// A bone's mesh as wrapping surface (4.34)-(4.45): the exact shortest way round the convex hull of
/// the mesh, on the side into which chi shows.
///
/// With P and Q the neighbouring path points, z = chi made orthogonal to PQ as in (4.36), and K the
/// hull of the mesh, the tendon is the shortest way from P to Q that avoids the inside of K and
/// stays in the half-space z . (x - P) >= 0. That is the geodesic over the part of the hull of K, P
/// and Q that lies on the chi side. Where (4.39) selects the mesh's vertices by that half-space, so
/// that the surface jumps when a vertex changes sides, here the solid is cut: length is continuous
/// in the posture. Hence:
/// - the tendon is straight exactly while the segment PQ does not cut K;
/// - where the shortest way would leave the half-space, it leans on its border. The border follows
///   P and Q, and the pulls carry what that costs, so that they remain the gradient of the length;
/// - without chi the tendon takes the shortest way of all.
/// chi is fixed in the mesh's body (the thesis: in that of the next point).
///
/// A point inside K is moved to the surface along the line from K's core, as those of spheres and
/// cylinders are moved away from centre and axis.
class MeshSurface final : public WrappingSurface {
 public:
  /// @param chi any length; zero: no side is preferred
  MeshSurface(std::vector<Vec3> points_B, const Vec3& chi_B, std::vector<std::string> remarks = {});

  std::string type() const override { return "mesh"; }
  std::size_t state_size() const override { return kHeader + capacity_; }
  void initialise(const Vec3& before, const Vec3& after, StateView state) const override;
  void wrap(const Vec3& before, const Vec3& after, StateView state,
            WrapContact& contact) const override;
  void trace(const WrapContact& contact, std::vector<Vec3>& points) const override;
  std::vector<std::string> remarks() const override { return remarks_; }
  /// With known distances from a fixed neighbour, the search only has to find out which facets the
  /// other neighbour sees.
  std::shared_ptr<const WrappingSurface> prepared_for(const Vec3* before,
                                                      const Vec3* after) const override;

  /// Statistics of the path search since initialise().
  struct Counts {
    double solved, improved, cold;
  };
  static Counts counts(StateView state);

  const ConvexHull& hull() const { return *hull_; }
  const Vec3& chi() const { return chi_; }  ///< unit or zero, in the body's frame

  /// `{file: , scale: , offset: [m], chi: [1], part: [{point: [m], normal: [1]}], selection:
  /// hull}`; with `selection: half_space` a SelectedMesh. The same description in the same file
  /// gives the same object.
  static std::shared_ptr<const WrappingSurface> load(const ConfigNode& node, const Pose& X_BL,
                                                     const MeshFiles& files = {});

 private:
  static std::shared_ptr<const WrappingSurface> prepare(const ConfigNode& node, const Pose& X_BL,
                                                        const MeshFiles& files);

  /// Head of the state: the facets below the neighbours in the last posture, and the direction and
  /// length of the strip that follows.
  struct Header {
    double facet_before, facet_after;
    double from_after;    ///< 1: the strip begins at the succeeding point
    double strip_length;  ///< edges
    Counts counts;
  };
  static constexpr std::size_t kHeader = state_size_of<Header>();

  /// One solved way, from the preceding to the succeeding point.
  struct Way {
    HullPoint before, after;
    bool wraps = false, reversed = false;
    Vec3 up = Vec3::Zero();
    bool limited = false;
  };

  void solve(const Vec3& before, const Vec3& after, StateView state, Way& way) const;
  void follow(const Vec3& before, const Vec3& after, const Way& way, WrapContact& contact) const;
  Vec3 crossing(int k) const;  ///< of the way in the workspace with its k-th edge

  /// Keeps the last computed distances, because searches build the same robot many times.
  struct FieldMemo {
    std::mutex mutex;
    std::shared_ptr<const DistanceField> last;
  };
  std::shared_ptr<const DistanceField> distances_from(const HullPoint& point) const;

  /// Whether this is the fixed point to which the distances belong.
  bool is_fixed(const HullPoint& point) const;

  std::shared_ptr<const ConvexHull> hull_;
  HullLocator locator_;
  Vec3 chi_;
  std::shared_ptr<const DistanceField> field_;  ///< null: no neighbour is fixed
  std::shared_ptr<FieldMemo> memo_ = std::make_shared<FieldMemo>();
  std::vector<std::string> remarks_;
  std::size_t capacity_;
};

}  // namespace anthrob
