#pragma once

#include <Eigen/Geometry>
#include <random>
#include <string>

#include "anthrob_reference/arm.h"
#include "anthrob_reference/skeleton.h"

namespace anthrob::reference {

inline std::string model_file(const std::string& name) {
  return std::string(ANTHROB_CONFIG_DIR) + "/anthrob/" + name + ".yaml";
}

inline Eigen::Quaterniond rotation(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation_vector / angle));
}

/// The state after moving for a unit of time at constant generalised velocity.
inline JointState moved(const JointState& state, const Vector4& displacement) {
  JointState result = state;
  result.shoulder = state.shoulder * rotation(displacement.head<3>());
  result.elbow += displacement(3);
  return result;
}

inline Vector4 random_vector(std::mt19937* generator, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  Vector4 v;
  for (int k = 0; k < 4; ++k) v(k) = uniform(*generator);
  return v;
}

/// Shoulder within about 25 degrees of rest, elbow 10 to 120 degrees, velocities up to 2 rad/s.
inline JointState random_state(std::mt19937* generator) {
  JointState state;
  state.elbow = 1.1;
  state = moved(state, random_vector(generator, 1.0).cwiseProduct(Vector4(0.25, 0.25, 0.25, 0.9)));
  state.velocity = random_vector(generator, 2.0);
  return state;
}

}  // namespace anthrob::reference
