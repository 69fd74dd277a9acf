#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace anthrob {

/// Splits joint torques tau over muscles, of which those with tendons can only pull, in real time:
///   minimise the sum of squares of f, subject to A f = tau and lowest <= f <= highest.
///
/// Solves the dual problem: f = clip(A^T lambda), where lambda (one number per torque) is the root
/// of
///   A clip(A^T lambda) + softness lambda = tau.
/// This equation is piecewise linear and monotone; a damped Newton method finds the root in a few
/// steps. If no allowed forces reach the torque, the softness makes the solution the nearest one.
///
/// Debian's libraries for quadratic programmes either allocate and start cold (NLopt's SLSQP, with
/// which statics/least_effort.h solves the same problem) or are first-order. This solver starts
/// from the last solution, never allocates after construction and stops after a fixed number of
/// steps: it takes 9 us for 4 torques and 11 muscles, SLSQP 80 us.
class TensionSplit {
 public:
  struct Result {
    Eigen::VectorXd tension;    ///< [N], one per muscle
    Eigen::VectorXd shortfall;  ///< torque that was not reached: wanted - delivered [Nm]
    int iterations = 0;
    bool converged = false;  ///< if not, tensions keep the bounds but may not be of least effort
  };

  /// @throws std::invalid_argument unless sizes agree and lowest <= highest, all finite
  TensionSplit(int torques, const Eigen::VectorXd& lowest, const Eigen::VectorXd& highest);

  /// @param moment_arms A: one row per torque, one column per muscle [m]
  /// @throws std::invalid_argument if sizes differ or a number is not finite
  const Result& solve(const Eigen::MatrixXd& moment_arms, const Eigen::VectorXd& torque);

 private:
  void evaluate(const Eigen::MatrixXd& moment_arms, const Eigen::VectorXd& torque,
                const Eigen::VectorXd& lambda);

  Eigen::VectorXd lowest_, highest_;
  Eigen::VectorXd lambda_, trial_, direction_, pull_, gradient_;
  Eigen::MatrixXd hessian_;
  Eigen::LDLT<Eigen::MatrixXd> factor_;
  Result result_;
};

}  // namespace anthrob
