#pragma once

#include <Eigen/Geometry>

#include "anthrob_reference/friction.h"
#include "anthrob_reference/parameters.h"
#include "anthrob_reference/posture.h"

namespace anthrob::reference {

/// Generalised coordinates and velocities of the two joints.
struct JointState {
  /// Rotation from rest in humerus axes: R_WH = R_WH(rest) R(shoulder).
  Eigen::Quaterniond shoulder = Eigen::Quaterniond::Identity();
  double elbow = 0.0;                  ///< [rad]
  Vector4 velocity = Vector4::Zero();  ///< humerus in its own axes, elbow [rad/s]
};

/// Two rigid bodies in minimal coordinates; Kane's equations M(q) du/dt = forces(q, u) + muscles.
class Skeleton final {
 public:
  explicit Skeleton(const SkeletonParameters& parameters);

  Posture posture(const JointState& state) const;
  /// Mass matrix for the generalised velocities [kg m^2].
  Matrix4 mass_matrix(const Posture& posture) const;
  /// Gravity, gyroscopic terms, joint friction and elbow stop [Nm].
  Vector4 forces(const JointState& state, const Posture& posture) const;
  /// Friction torque of the joints per velocity, for the implicit part of the integration
  /// [Nms/rad].
  Matrix4 damping(const JointState& state) const;

  /// A stop of the elbow pushes.
  bool at_stop(const JointState& state) const;

  Eigen::Vector3d weight(const JointState& state) const;   ///< of both bodies, humerus axes [N]
  double kinetic_energy(const JointState& state) const;    ///< [J]
  double potential_energy(const JointState& state) const;  ///< of gravity, 0 at the shoulder [J]

 private:
  // Forearm quantities that the mass matrix and the forces share, in H.
  struct Forearm {
    Eigen::Vector3d p_EC;     // elbow to centre of mass
    Eigen::Matrix3d inertia;  // about the centre of mass
  };
  Forearm forearm(const Posture& posture) const;
  Vector4 friction(const Vector4& velocity) const;
  double stop_torque(double angle, double speed) const;
  Eigen::Vector3d gravity_in_humerus(const JointState& state) const;

  SkeletonParameters parameters_;
  Eigen::Isometry3d X_SB_rest_;  // base seen from S at rest, humerus axes
  Eigen::Vector3d gravity_H_rest_;
  Eigen::Vector3d p_SC_;       // shoulder to the humerus' centre of mass
  Eigen::Matrix3d inertia_S_;  // of the humerus about the shoulder
  Eigen::Vector3d p_SE_;       // shoulder to elbow
  Eigen::Vector3d elbow_axis_H_;
  SmoothStribeck shoulder_dry_;
  SmoothStribeck elbow_dry_;
};

}  // namespace anthrob::reference
