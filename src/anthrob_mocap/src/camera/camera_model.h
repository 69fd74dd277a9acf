#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/types.h"

namespace anthrob {
namespace mocap {

/// One camera of the pair as ROS calibrators describe it: z forward, x right, y down; a pinhole
/// behind a lens of the "plumb_bob" or "rational_polynomial" kind.
struct CameraModel {
  using Projection = Eigen::Matrix<double, 3, 4>;

  std::string name;
  int width = 0;
  int height = 0;
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< camera_matrix [pixel]
  std::array<double, 8> distortion{};             ///< k1 k2 p1 p2 k3 k4 k5 k6
  Mat3 R = Mat3::Identity();                      ///< camera -> rectified axes
  Projection P = Projection::Zero();              ///< rectified left frame -> rectified pixel

  /// Reads DIR/left.yaml and the like, of camera_calibration, image_pipeline or OpenCV's ROS tools.
  /// @throws BadInput with file, line, key and reason
  static CameraModel load(const std::string& file);
  /// The file as the ROS calibrators write it.
  std::string to_yaml() const;

  /// Ideal image point (x/z, y/z) to where the lens puts it, and back. The way back iterates to
  /// 1e-12; far outside the image, where the lens polynomial folds over, it may not exist: then
  /// the result is NaN.
  Vec2 distort(const Vec2& ideal) const;
  Vec2 undistort(const Vec2& distorted) const;

  /// Pixel of a point in the camera's (not rectified) frame, z > 0.
  Vec2 project(const Vec3& p_C) const;
  /// Ideal image point of a pixel.
  Vec2 ideal(const Vec2& pixel) const;
};

/// What any calibration must be, from a file or a topic.
/// What is wrong with [fx, 0, cx, 0, fy, cy, 0, 0, 1], fx, fy > 0, (cx, cy) in the picture [pixel].
std::optional<std::string> camera_matrix_fault(const Mat3& K, int width, int height);
bool is_rotation(const Mat3& R);  ///< a mirrored one is none
/// [f, 0, cx, Tx, 0, f, cy, Ty, 0, 0, 1, 0], f > 0
bool is_rectified(const CameraModel::Projection& P);
bool is_distortion_count(std::size_t coefficients);  ///< 4, 5 or 8

}  // namespace mocap
}  // namespace anthrob
