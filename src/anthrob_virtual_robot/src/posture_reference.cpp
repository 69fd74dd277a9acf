#include "posture_reference.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace anthrob::virtual_robot {

Eigen::Quaterniond rotation(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

Pose blend(const Pose& a, const Pose& b, double share) {
  Pose pose;
  pose.shoulder = a.shoulder + share * (b.shoulder - a.shoulder);
  pose.elbow = a.elbow + share * (b.elbow - a.elbow);
  pose.lowest_tension = a.lowest_tension + share * (b.lowest_tension - a.lowest_tension);
  return pose;
}

Eigen::VectorXd least_effort(const Eigen::MatrixXd& A, const Eigen::VectorXd& torque,
                             double lowest) {
  constexpr double kSoftness = 1e-9;  // where the torque cannot be had, multipliers stay finite
  constexpr int kSteps = 60;
  const auto forces = [&](const Eigen::VectorXd& dual) -> Eigen::VectorXd {
    return (A.transpose() * dual).cwiseMax(lowest);
  };
  // The dual function, to be made least; its gradient is the missing torque.
  const auto value = [&](const Eigen::VectorXd& dual) {
    const Eigen::VectorXd f = forces(dual);
    return (A.transpose() * dual).dot(f) - 0.5 * f.squaredNorm() - torque.dot(dual) +
           0.5 * kSoftness * dual.squaredNorm();
  };
  Eigen::VectorXd dual = Eigen::VectorXd::Zero(torque.size());
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::VectorXd f = forces(dual);
    const Eigen::VectorXd gradient = A * f - torque + kSoftness * dual;
    if (gradient.norm() < 1e-12) break;
    Eigen::MatrixXd free = A;
    for (Eigen::Index i = 0; i < f.size(); ++i) {
      if (f(i) <= lowest) free.col(i).setZero();
    }
    Eigen::MatrixXd hessian = free * free.transpose();
    hessian.diagonal().array() += kSoftness + 1e-6 * A.squaredNorm();
    const Eigen::VectorXd direction = hessian.ldlt().solve(-gradient);
    double length = 1.0;
    const double before = value(dual);
    while (length > 1e-6 &&
           value(dual + length * direction) > before + 1e-4 * length * gradient.dot(direction)) {
      length *= 0.5;
    }
    dual += length * direction;
  }
  return forces(dual);
}

PostureReference::PostureReference(const reference::ArmParameters& parameters)
    : parameters_(parameters), skeleton_(parameters.skeleton), arm_(parameters) {}

std::vector<double> PostureReference::positions(const Pose& pose) {
  const auto count = static_cast<Eigen::Index>(parameters_.muscles.size());
  const Eigen::Quaterniond shoulder = rotation(pose.shoulder);
  arm_.place(shoulder, pose.elbow, std::vector<double>(parameters_.muscles.size(), 0.0));
  Eigen::MatrixXd arms(4, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    arms.col(i) = arm_.moment_arm(static_cast<std::size_t>(i));
  }
  reference::JointState state;
  state.shoulder = shoulder;
  state.elbow = pose.elbow;
  const reference::Vector4 weight = skeleton_.forces(state, skeleton_.posture(state));
  const Eigen::VectorXd tensions = least_effort(arms, -weight, pose.lowest_tension);
  std::vector<double> positions;
  for (std::size_t i = 0; i < parameters_.muscles.size(); ++i) {
    const reference::MuscleParameters& muscle = parameters_.muscles[i];
    const reference::RingParameters& ring = muscle.ring;
    const double area =
        ring.quantity * ring.strands * M_PI / 4.0 * ring.section_diameter * ring.section_diameter;
    const double stretch =
        ring.rest_length * tensions(static_cast<Eigen::Index>(i)) / (area * ring.modulus);
    const double tendon = arm_.muscle(i).length - ring.rest_length - stretch;
    positions.push_back((muscle.rest_tendon_length - tendon) / muscle.spindle_radius);
  }
  return positions;
}

}  // namespace anthrob::virtual_robot
