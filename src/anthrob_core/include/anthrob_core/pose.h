#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace anthrob {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

constexpr double kDegrees = 57.29577951308232;  ///< in a radian

/// Pose of a frame B in a frame A: p_A = R p_B + p.
struct Pose {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();

  Vec3 operator*(const Vec3& point) const { return R * point + p; }
  Pose operator*(const Pose& other) const { return {R * other.R, R * other.p + p}; }
  /// The point of A, expressed in B.
  Vec3 to_local(const Vec3& point) const { return R.transpose() * (point - p); }
  Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

/// The same rotation with w >= 0, the form in which orientations are published.
inline Quat canonical(const Quat& q) {
  return q.w() < 0 ? Quat(-q.w(), -q.x(), -q.y(), -q.z()) : q;
}

/// Rotation angle [rad] in [0, pi] that turns a into b: the joint error of a ball joint.
inline double angular_distance(const Quat& a, const Quat& b) {
  const Quat d = a.conjugate() * b;
  return 2.0 * std::atan2(d.vec().norm(), std::abs(d.w()));
}

}  // namespace anthrob
