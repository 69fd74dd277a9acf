#pragma once

#include <Eigen/Core>

namespace anthrob {

/// Distribution of joint torques over muscles, which can only pull.
struct LeastEffort {
  Eigen::VectorXd tension;  ///< [N], one per muscle
  /// Torque that no allowed tensions can deliver: required - delivered [Nm]; zero if the posture
  /// can be held.
  Eigen::VectorXd shortfall;
};

/// Finds the tensions f of least sum of squares with A f = tau and lowest <= f <= highest. If there
/// are none, finds the tensions whose torque is nearest to tau.
/// @param moment_arms A, one row per generalised velocity, one column per muscle [m]
/// @param torque tau, which the muscles have to deliver [Nm]
/// @param lowest,highest by muscle [N]; 0 <= lowest <= highest
/// @throws std::invalid_argument if sizes or bounds do not fit
LeastEffort least_effort(const Eigen::MatrixXd& moment_arms, const Eigen::VectorXd& torque,
                         const Eigen::VectorXd& lowest, const Eigen::VectorXd& highest);

}  // namespace anthrob
