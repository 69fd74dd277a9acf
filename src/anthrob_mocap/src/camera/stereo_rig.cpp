#include "camera/stereo_rig.h"

#include <cmath>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace mocap {

StereoRig StereoRig::load(const std::string& folder) {
  try {
    const CameraModel left = CameraModel::load(folder + "/left.yaml");
    return StereoRig(left, CameraModel::load(folder + "/right.yaml"), ".yaml");
  } catch (const BadInput& error) {
    const std::string what = error.what();
    if (what.rfind(folder, 0) == 0) throw;
    throw BadInput(folder + ": " + what);
  }
}

StereoRig::StereoRig(const CameraModel& left, const CameraModel& right, const std::string& origin)
    : cameras_{left, right},
      focal_(left.P(0, 0)),
      baseline_(-right.P(0, 3) / right.P(0, 0)),
      centre_{{left.P(0, 2), left.P(1, 2)}, {right.P(0, 2), right.P(1, 2)}} {
  check("left" + origin, "right" + origin);
}

void StereoRig::check(const std::string& left_name, const std::string& right_name) const {
  const CameraModel &left = cameras_[kLeft], &right = cameras_[kRight];
  const auto text = [](double value) { return std::to_string(value); };
  if (left.width != right.width || left.height != right.height) {
    throw BadInput(left_name + " and " + right_name + ": expected images of the same size, not " +
                   std::to_string(left.width) + "x" + std::to_string(left.height) + " and " +
                   std::to_string(right.width) + "x" + std::to_string(right.height));
  }
  if (left.P(0, 3) < 0.0 && right.P(0, 3) == 0.0) {
    throw BadInput(left_name +
                   ": projection_matrix: left and right are swapped: this one has the baseline, " +
                   text(-left.P(0, 3) / left.P(0, 0)) + " m, which belongs to the right camera");
  }
  if (left.P(0, 3) != 0.0 || left.P(1, 3) != 0.0) {
    throw BadInput(left_name + ": projection_matrix: expected Tx = Ty = 0 for the left camera");
  }
  if (right.P(1, 3) != 0.0) {
    throw BadInput(right_name + ": projection_matrix: Ty = " + text(right.P(1, 3)) +
                   ": expected cameras side by side, not one above the other");
  }
  if (baseline_ < 0.0) {
    throw BadInput(right_name + ": projection_matrix: baseline " + text(baseline_) +
                   " m: left and right are swapped, or the calibration is mirrored");
  }
  if (!(baseline_ > 1e-3 && baseline_ < 5.0)) {
    throw BadInput(right_name + ": projection_matrix: baseline " + text(baseline_) +
                   " m: expected the calibration of a pair in metres (between 0.001 and 5)");
  }
  if (std::abs(left.P(0, 0) - right.P(0, 0)) > 1e-6 * focal_ ||
      std::abs(left.P(1, 2) - right.P(1, 2)) > 1e-6 * focal_) {
    throw BadInput(left_name + " and " + right_name +
                   ": projection_matrix: expected the same f and cy in "
                   "both; these are not from one stereo calibration");
  }
}

Vec2 StereoRig::rectify(Side side, const Vec2& pixel) const {
  const Vec2 ideal = cameras_[side].ideal(pixel);
  return rectified_pixel(side, cameras_[side].R * Vec3(ideal.x(), ideal.y(), 1.0));
}

Vec3 StereoRig::rectified_ray(Side side, const Vec2& pixel) const {
  const Vec2 m = (pixel - centre_[side]) / focal_;
  return {m.x(), m.y(), 1.0};
}

Vec3 StereoRig::in_camera(Side side, const Vec3& p) const {
  const Vec3 from_camera = side == kLeft ? p : Vec3(p - Vec3(baseline_, 0.0, 0.0));
  return cameras_[side].R.transpose() * from_camera;
}

Vec2 StereoRig::project_rectified(Side side, const Vec3& p) const {
  return rectified_pixel(side, side == kLeft ? p : Vec3(p - Vec3(baseline_, 0.0, 0.0)));
}

double StereoRig::disparity(const Vec2& left, const Vec2& right) const {
  return (left.x() - centre_[kLeft].x()) - (right.x() - centre_[kRight].x());
}

Vec3 StereoRig::triangulate(const Vec2& left, const Vec2& right) const {
  const double z = focal_ * baseline_ / disparity(left, right);
  const double v = 0.5 * (left.y() + right.y()) - centre_[kLeft].y();
  return {(left.x() - centre_[kLeft].x()) * z / focal_, v * z / focal_, z};
}

}  // namespace mocap
}  // namespace anthrob
