#include <nlopt.hpp>
#include <stdexcept>

#include "anthrob_sim/statics/equilibrium.h"

namespace anthrob {

namespace {

/// A newton metre of shortfall costs as much as this many newtons in one muscle.
constexpr double kShortfallWeight = 1e5;

struct Problem {
  Eigen::MatrixXd A;  ///< moment arms, then the scaled shortfall: A f + s / weight = tau
  Eigen::VectorXd tau;
};

// Sum of squares: its Hessian is the identity, with which SLSQP starts, so that its first quadratic
// programme is already the whole problem.
double effort(const std::vector<double>& x, std::vector<double>& gradient, void*) {
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += 0.5 * x[i] * x[i];
    if (!gradient.empty()) gradient[i] = x[i];
  }
  return sum;
}

void balance(unsigned m, double* result, unsigned n, const double* x, double* gradient,
             void* data) {
  const auto& problem = *static_cast<const Problem*>(data);
  const Eigen::Map<const Eigen::VectorXd> z(x, n);
  Eigen::Map<Eigen::VectorXd>(result, m) = problem.A * z - problem.tau;
  if (!gradient) return;
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(gradient, m,
                                                                                     n) = problem.A;
}

}  // namespace

LeastEffort least_effort(const Eigen::MatrixXd& moment_arms, const Eigen::VectorXd& torque,
                         const Eigen::VectorXd& lowest, const Eigen::VectorXd& highest) {
  const Eigen::Index muscles = moment_arms.cols(), torques = moment_arms.rows();
  if (torque.size() != torques || lowest.size() != muscles || highest.size() != muscles) {
    throw std::invalid_argument("least_effort: sizes of moment arms, torque and bounds do not fit");
  }
  if ((lowest.array() > highest.array()).any()) {
    throw std::invalid_argument("least_effort: a lowest tension is above its highest");
  }
  LeastEffort result;
  result.tension = lowest;
  result.shortfall = torque;
  if (muscles == 0 || torques == 0) return result;

  const Eigen::Index n = muscles + torques;
  Problem problem{Eigen::MatrixXd::Zero(torques, n), torque};
  problem.A.leftCols(muscles) = moment_arms;
  problem.A.rightCols(torques) = Eigen::MatrixXd::Identity(torques, torques) / kShortfallWeight;

  std::vector<double> lo(n, -HUGE_VAL), hi(n, HUGE_VAL), x(n, 0.0);
  for (Eigen::Index i = 0; i < muscles; ++i) lo[i] = x[i] = lowest[i], hi[i] = highest[i];
  nlopt::opt solver(nlopt::LD_SLSQP, static_cast<unsigned>(n));
  solver.set_lower_bounds(lo);
  solver.set_upper_bounds(hi);
  solver.set_min_objective(effort, nullptr);
  solver.add_equality_mconstraint(balance, &problem, std::vector<double>(torques, 1e-12));
  solver.set_xtol_abs(1e-9);
  solver.set_maxeval(50);
  double value = 0.0;
  try {
    solver.optimize(x, value);
  } catch (const nlopt::roundoff_limited&) {
    // As good as doubles allow.
  }
  const Eigen::Map<const Eigen::VectorXd> z(x.data(), n);
  result.tension = z.head(muscles).cwiseMax(lowest).cwiseMin(highest);
  result.shortfall = torque - moment_arms * result.tension;
  return result;
}

}  // namespace anthrob
