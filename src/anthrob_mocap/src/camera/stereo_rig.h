#pragma once

#include <array>
#include <cmath>
#include <string>

#include "camera/camera_model.h"

namespace anthrob {
namespace mocap {

/// The calibrated pair. Positions are in the left camera's rectified frame: z forward, x towards
/// the right camera. In rectified pixels (u, v) a point has the same v in both images, and
///   u_left - cx_left - (u_right - cx_right) = f B / z.
class StereoRig {
 public:
  /// Reads DIR/left.yaml and DIR/right.yaml.
  /// @throws BadInput if they are swapped, no pair, or of different shape
  static StereoRig load(const std::string& folder);
  /// @param origin of the calibrations, for messages: "left" and "right" go before it
  StereoRig(const CameraModel& left, const CameraModel& right,
            const std::string& origin = " camera");

  const CameraModel& camera(Side side) const { return cameras_[side]; }
  int width() const { return cameras_[0].width; }
  int height() const { return cameras_[0].height; }
  double focal() const { return focal_; }        ///< of the rectified images [pixel]
  double baseline() const { return baseline_; }  ///< [m]
  /// Rectified pixels per pixel of the cameras: calibrators choose the scale freely.
  double zoom() const { return focal_ / std::sqrt(cameras_[0].fx * cameras_[0].fy); }

  /// Rectified pixel of a pixel; NaN where the lens model has no inverse.
  Vec2 rectify(Side side, const Vec2& pixel) const;
  /// A point of the rectified left frame in a camera's own frame.
  Vec3 in_camera(Side side, const Vec3& p) const;
  /// Direction of a rectified pixel, z = 1, and the way back, in rectified axes.
  Vec3 rectified_ray(Side side, const Vec2& pixel) const;
  Vec2 rectified_pixel(Side side, const Vec3& direction) const {
    return centre_[side] + focal_ / direction.z() * direction.head<2>();
  }
  Vec2 project_rectified(Side side, const Vec3& p) const;
  Vec2 project(Side side, const Vec3& p) const {
    return cameras_[side].project(in_camera(side, p));
  }

  /// Rows moved to their mean, which is what optimal triangulation [Hartley, Sturm] amounts to in a
  /// rectified pair: the least movement of both points that brings them onto one epipolar line.
  Vec3 triangulate(const Vec2& left, const Vec2& right) const;
  /// f B / z of a pair of rectified points [pixel]; not positive: no point in front of the cameras.
  double disparity(const Vec2& left, const Vec2& right) const;

 private:
  void check(const std::string& left_name, const std::string& right_name) const;

  std::array<CameraModel, 2> cameras_;
  double focal_, baseline_;
  Vec2 centre_[2];
};

}  // namespace mocap
}  // namespace anthrob
