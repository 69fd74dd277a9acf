#include "anthrob_reference/skeleton.h"

#include <algorithm>
#include <cmath>

#include "check.h"

namespace anthrob::reference {
namespace {

// Moment of inertia about a point at `offset` from the centre of mass, less the central one.
Eigen::Matrix3d steiner(double mass, const Eigen::Vector3d& offset) {
  return mass * (offset.squaredNorm() * Eigen::Matrix3d::Identity() - offset * offset.transpose());
}

// friction / speed, continued at rest; bounds the slope of a smooth Stribeck curve well enough for
// an approximate Jacobian.
double secant(const SmoothStribeck& curve, double speed) {
  constexpr double kAtRest = 1e-9;
  return speed > kAtRest ? curve.value(speed) / speed : curve.slope(0.0);
}

}  // namespace

Skeleton::Skeleton(const SkeletonParameters& parameters)
    : parameters_(parameters),
      X_SB_rest_(parameters.X_WH_rest.inverse() * parameters.X_WB),
      gravity_H_rest_(parameters.X_WH_rest.linear().transpose() * parameters.gravity_W),
      p_SC_(parameters.humerus.com - parameters.p_HS),
      inertia_S_(parameters.humerus.inertia + steiner(parameters.humerus.mass, p_SC_)),
      p_SE_(parameters.X_HF_zero.translation() - parameters.p_HS),
      elbow_axis_H_(parameters.X_HF_zero.linear() * parameters.elbow_axis_F),
      shoulder_dry_(parameters.shoulder_friction.dry),
      elbow_dry_(parameters.elbow_friction.dry) {
  require_positive("humerus mass", parameters.humerus.mass);
  require_positive("forearm mass", parameters.forearm.mass);
  require(std::abs(parameters.elbow_axis_F.norm() - 1.0) < 1e-9, "an elbow axis of length 1",
          parameters.elbow_axis_F.norm());
  X_SB_rest_.pretranslate(-parameters.p_HS);
}

Posture Skeleton::posture(const JointState& state) const {
  const Eigen::Matrix3d R = state.shoulder.toRotationMatrix();
  Posture posture;
  // The humerus is the observer, so it is the base that turns, and backwards.
  Posture::Frame& base = posture.frames[static_cast<std::size_t>(Body::kBase)];
  base.R_HX = R.transpose() * X_SB_rest_.linear();
  base.p_SX = R.transpose() * X_SB_rest_.translation();
  posture.frames[static_cast<std::size_t>(Body::kHumerus)].p_SX = -parameters_.p_HS;
  Posture::Frame& forearm = posture.frames[static_cast<std::size_t>(Body::kForearm)];
  forearm.R_HX = parameters_.X_HF_zero.linear() *
                 Eigen::AngleAxisd(state.elbow, parameters_.elbow_axis_F).toRotationMatrix();
  forearm.p_SX = p_SE_;
  posture.elbow_axis = elbow_axis_H_;
  posture.elbow_centre = p_SE_;
  return posture;
}

Skeleton::Forearm Skeleton::forearm(const Posture& posture) const {
  const Eigen::Matrix3d& R_HF = posture.frame(Body::kForearm).R_HX;
  return {R_HF * parameters_.forearm.com, R_HF * parameters_.forearm.inertia * R_HF.transpose()};
}

Matrix4 Skeleton::mass_matrix(const Posture& posture) const {
  const Forearm arm = forearm(posture);
  const double mass = parameters_.forearm.mass;
  const Eigen::Vector3d p_SC = p_SE_ + arm.p_EC;
  const Eigen::Vector3d swing = elbow_axis_H_.cross(arm.p_EC);  // velocity of C per elbow speed
  const Eigen::Vector3d spin = arm.inertia * elbow_axis_H_;
  Matrix4 M;
  M.topLeftCorner<3, 3>() = inertia_S_ + arm.inertia + steiner(mass, p_SC);
  M.topRightCorner<3, 1>() = spin + mass * p_SC.cross(swing);
  M.bottomLeftCorner<1, 3>() = M.topRightCorner<3, 1>().transpose();
  M(3, 3) = elbow_axis_H_.dot(spin) + mass * swing.squaredNorm();
  return M;
}

Vector4 Skeleton::forces(const JointState& state, const Posture& posture) const {
  const Forearm arm = forearm(posture);
  const Eigen::Vector3d gravity = gravity_in_humerus(state);
  const Eigen::Vector3d w1 = state.velocity.head<3>();
  const Eigen::Vector3d elbow_rate = state.velocity(3) * elbow_axis_H_;
  const Eigen::Vector3d w2 = w1 + elbow_rate;
  // What the forearm accelerates by while all generalised accelerations are zero.
  const Eigen::Vector3d spin = w1.cross(elbow_rate);
  const Eigen::Vector3d a_C =
      w1.cross(w1.cross(p_SE_)) + spin.cross(arm.p_EC) + w2.cross(w2.cross(arm.p_EC));
  const Eigen::Vector3d force = parameters_.forearm.mass * (gravity - a_C);
  const Eigen::Vector3d moment = -arm.inertia * spin - w2.cross(arm.inertia * w2);
  Vector4 result = friction(state.velocity);
  result.head<3>() += -w1.cross(inertia_S_ * w1) + parameters_.humerus.mass * p_SC_.cross(gravity) +
                      (p_SE_ + arm.p_EC).cross(force) + moment;
  result(3) += elbow_axis_H_.dot(arm.p_EC.cross(force) + moment) +
               stop_torque(state.elbow, state.velocity(3));
  return result;
}

Vector4 Skeleton::friction(const Vector4& velocity) const {
  const Eigen::Vector3d w = velocity.head<3>();
  Vector4 result;
  result.head<3>() = -parameters_.shoulder_friction.viscous * w;
  result(3) = -parameters_.elbow_friction.viscous * velocity(3);
  // Against the rotation as a whole (3.7).
  if (!shoulder_dry_.vanishes()) result.head<3>() -= secant(shoulder_dry_, w.norm()) * w;
  if (!elbow_dry_.vanishes()) result(3) -= elbow_dry_.value(velocity(3));
  return result;
}

Matrix4 Skeleton::damping(const JointState& state) const {
  double shoulder = parameters_.shoulder_friction.viscous;
  double elbow = parameters_.elbow_friction.viscous;
  if (!shoulder_dry_.vanishes()) shoulder += secant(shoulder_dry_, state.velocity.head<3>().norm());
  if (!elbow_dry_.vanishes()) elbow += secant(elbow_dry_, std::abs(state.velocity(3)));
  return Vector4(shoulder, shoulder, shoulder, elbow).asDiagonal();
}

double Skeleton::stop_torque(double angle, double speed) const {
  const StopParameters& stop = parameters_.elbow_stop;
  if (angle < stop.lower) {
    return std::max(0.0, stop.stiffness * (stop.lower - angle) - stop.damping * speed);
  }
  if (angle > stop.upper) {
    return -std::max(0.0, stop.stiffness * (angle - stop.upper) + stop.damping * speed);
  }
  return 0.0;
}

bool Skeleton::at_stop(const JointState& state) const {
  return stop_torque(state.elbow, state.velocity(3)) != 0.0;
}

Eigen::Vector3d Skeleton::gravity_in_humerus(const JointState& state) const {
  return state.shoulder.conjugate() * gravity_H_rest_;
}

Eigen::Vector3d Skeleton::weight(const JointState& state) const {
  return (parameters_.humerus.mass + parameters_.forearm.mass) * gravity_in_humerus(state);
}

double Skeleton::kinetic_energy(const JointState& state) const {
  return 0.5 * state.velocity.dot(mass_matrix(posture(state)) * state.velocity);
}

double Skeleton::potential_energy(const JointState& state) const {
  const Eigen::Vector3d p_SC = p_SE_ + forearm(posture(state)).p_EC;
  return -gravity_in_humerus(state).dot(parameters_.humerus.mass * p_SC_ +
                                        parameters_.forearm.mass * p_SC);
}

}  // namespace anthrob::reference
