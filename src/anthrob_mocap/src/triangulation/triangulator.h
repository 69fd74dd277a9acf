#pragma once

#include <vector>

#include "camera/stereo_rig.h"
#include "matching/epipolar_matcher.h"

namespace anthrob {
namespace mocap {

/// A point in space that could be a marker.
struct MarkerPoint {
  Vec3 p = Vec3::Zero();  ///< centre, rectified left frame [m]
  /// Rectified pixels of the centre, before the rows are averaged
  Vec2 image[2] = {Vec2::Zero(), Vec2::Zero()};
  int blob[2] = {-1, -1};  ///< the blob of each image that it was triangulated from
};

/// Triangulates matches (optimally, see StereoRig::triangulate) and corrects for the outlines of
/// spheres: the outline of a sphere is an ellipse, whose centre lies farther from the image
/// centre than the sphere's does. For a sphere of radius r at depth z of a pinhole, exactly,
///   m_centre = m_ellipse (1 - r^2 / z^2).
class Triangulator {
 public:
  /// @param marker_radius [m]; 0 for flat markers
  Triangulator(const StereoRig& rig, double marker_radius) : rig_(rig), radius_(marker_radius) {}

  /// @param points rectified centroids, by side
  /// @param result replaced; one for every match
  void triangulate(const std::array<std::vector<Vec2>, 2>& points,
                   const std::vector<Match>& matches, std::vector<MarkerPoint>& result) const;

 private:
  Vec2 centre_of_sphere(Side side, const Vec2& ellipse, const Vec3& p) const;

  StereoRig rig_;
  double radius_;
};

}  // namespace mocap
}  // namespace anthrob
