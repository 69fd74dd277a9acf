#include "triangulation/triangulator.h"

namespace anthrob {
namespace mocap {

void Triangulator::triangulate(const std::array<std::vector<Vec2>, 2>& points,
                               const std::vector<Match>& matches,
                               std::vector<MarkerPoint>& result) const {
  result.clear();
  for (const Match& match : matches) {
    const Vec2& left = points[kLeft][static_cast<std::size_t>(match.left)];
    const Vec2& right = points[kRight][static_cast<std::size_t>(match.right)];
    MarkerPoint marker;
    // The depth enters the correction as r^2/z^2: the uncorrected one is good enough for it.
    const Vec3 p = rig_.triangulate(left, right);
    marker.image[kLeft] = centre_of_sphere(kLeft, left, p);
    marker.image[kRight] = centre_of_sphere(kRight, right, p);
    marker.p = rig_.triangulate(marker.image[kLeft], marker.image[kRight]);
    marker.blob[kLeft] = match.left, marker.blob[kRight] = match.right;
    result.push_back(marker);
  }
}

Vec2 Triangulator::centre_of_sphere(Side side, const Vec2& ellipse, const Vec3& p) const {
  if (radius_ <= 0.0) return ellipse;
  // The outline is that in the real camera, not in the rectified one.
  const Mat3& R = rig_.camera(side).R;
  const double depth = rig_.in_camera(side, p).z();
  const Vec3 d = R.transpose() * rig_.rectified_ray(side, ellipse);
  const double shrink = 1.0 - radius_ * radius_ / (depth * depth);
  return rig_.rectified_pixel(side, R * Vec3(shrink * d.x(), shrink * d.y(), d.z()));
}

}  // namespace mocap
}  // namespace anthrob
