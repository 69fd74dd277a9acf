#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace anthrob {

/// Splits joint torques over muscles that can only pull, in real time:
///   least sum of squares of f, with A f = tau and lowest <= f <= highest.
///
/// Solved in its dual: f = clip(A^T lambda), and lambda, one number a torque, is the root of
///   A clip(A^T lambda) + softness lambda = tau,
/// piecewise linear and monotone, found by a damped Newton method in a few steps. Where no allowed
/// forces reach the torque the softness makes it the nearest one.
///
/// Debian's libraries for quadratic programmes either allocate and start cold (NLopt's SLSQP, with
/// which statics/least_effort.h solves the same problem) or are first-order; this one starts from
/// the last solution, never allocates after construction and stops after a fixed number of steps:
/// 9 us for 4 torques and 11 muscles where SLSQP takes 80.
class TensionSplit {
 public:
  struct Result {
    Eigen::VectorXd tension;    ///< [N], one a muscle
    Eigen::VectorXd shortfall;  ///< torque that was not reached: wanted - delivered [Nm]
    int iterations = 0;
    bool converged = false;  ///< if not, tensions are allowed but may not be those of least effort
  };

  /// @throws std::invalid_argument if sizes differ, or not 0 <= lowest <= highest, or not finite
  TensionSplit(int torques, const Eigen::VectorXd& lowest, const Eigen::VectorXd& highest);

  /// @param moment_arms A, one row a torque, one column a muscle [m]
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
