#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "anthrob_core/pose.h"

namespace anthrob {
namespace mocap {

using Vec2 = Eigen::Vector2d;
using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Which camera of the pair; also an index.
enum Side { kLeft = 0, kRight = 1 };
inline const char* name(Side side) {
  return side == kLeft ? "left" : "right";
}

/// Of unit length with w >= 0, as published.
inline Quat canonical(const Quat& q) {
  return anthrob::canonical(q.normalized());
}

/// The rotation by |w| about w.
inline Mat3 exp_rotation(const Vec3& w) {
  const double angle = w.norm();
  if (angle < 1e-12) return Mat3::Identity();
  return Eigen::AngleAxisd(angle, w / angle).toRotationMatrix();
}

/// The vector whose rotation is R, of length in [0, pi].
inline Vec3 log_rotation(const Mat3& R) {
  const Eigen::AngleAxisd turn{canonical(Quat(R))};
  return turn.angle() * turn.axis();
}

/// Angle of the rotation between two orientations, in [0, pi].
inline double angular_distance(const Mat3& a, const Mat3& b) {
  return log_rotation(a.transpose() * b).norm();
}

}  // namespace mocap
}  // namespace anthrob
