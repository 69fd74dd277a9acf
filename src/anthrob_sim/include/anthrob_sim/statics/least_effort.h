#pragma once

#include <Eigen/Core>

namespace anthrob {

/// Splits joint torques over muscles that can only pull.
struct LeastEffort {
  Eigen::VectorXd tension;  ///< [N], one a muscle
  /// Torque that no allowed tensions reach: required - delivered [Nm]; zero if the posture can be
  /// held.
  Eigen::VectorXd shortfall;
};

/// The tensions of least sum of squares with A f = tau and lowest <= f <= highest. If no such
/// tensions exist, the nearest torque that can be had.
/// @param moment_arms A, one row a generalised velocity, one column a muscle [m]
/// @param torque tau, what the muscles have to deliver [Nm]
/// @param lowest,highest by muscle [N]; 0 <= lowest <= highest
/// @throws std::invalid_argument if sizes or bounds do not fit
LeastEffort least_effort(const Eigen::MatrixXd& moment_arms, const Eigen::VectorXd& torque,
                         const Eigen::VectorXd& lowest, const Eigen::VectorXd& highest);

}  // namespace anthrob
