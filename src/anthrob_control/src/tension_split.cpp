#include "anthrob_control/tension_split.h"

#include <cmath>
#include <stdexcept>

namespace anthrob {

namespace {

/// A newton metre of shortfall costs as much as 1e4 newtons in one muscle: what can be reached is
/// reached within some 1e-5 Nm.
constexpr double kSoftness = 1e-8;
constexpr int kMaxIterations = 60;
constexpr int kMaxHalvings = 30;

}  // namespace

TensionSplit::TensionSplit(int torques, const Eigen::VectorXd& lowest,
                           const Eigen::VectorXd& highest)
    : lowest_(lowest), highest_(highest) {
  if (torques < 0 || lowest.size() != highest.size()) {
    throw std::invalid_argument("TensionSplit: lowest and highest differ in size");
  }
  if (!lowest.allFinite() || !highest.allFinite() || (lowest.array() > highest.array()).any()) {
    throw std::invalid_argument("TensionSplit: expected lowest <= highest, finite");
  }
  lambda_ = trial_ = direction_ = gradient_ = Eigen::VectorXd::Zero(torques);
  pull_ = result_.tension = lowest;
  result_.shortfall = Eigen::VectorXd::Zero(torques);
  hessian_ = Eigen::MatrixXd::Zero(torques, torques);
  factor_ = Eigen::LDLT<Eigen::MatrixXd>(torques);
}

// The tensions that belong to a lambda, and the gradient of the dual function there.
void TensionSplit::evaluate(const Eigen::MatrixXd& moment_arms, const Eigen::VectorXd& torque,
                            const Eigen::VectorXd& lambda) {
  pull_.noalias() = moment_arms.transpose() * lambda;
  result_.tension = pull_.cwiseMax(lowest_).cwiseMin(highest_);
  gradient_.noalias() = moment_arms * result_.tension;
  gradient_ += kSoftness * lambda - torque;
}

const TensionSplit::Result& TensionSplit::solve(const Eigen::MatrixXd& moment_arms,
                                                const Eigen::VectorXd& torque) {
  if (moment_arms.rows() != lambda_.size() || moment_arms.cols() != lowest_.size() ||
      torque.size() != lambda_.size()) {
    throw std::invalid_argument("TensionSplit: sizes of moment arms and torque do not fit");
  }
  if (!moment_arms.allFinite() || !torque.allFinite()) {
    throw std::invalid_argument("TensionSplit: moment arms or torque are not finite");
  }
  const double small = 1e-10 * (1.0 + torque.norm());
  result_.converged = false;
  evaluate(moment_arms, torque, lambda_);
  for (result_.iterations = 0; result_.iterations < kMaxIterations; ++result_.iterations) {
    if (gradient_.norm() <= small) {
      result_.converged = true;
      break;
    }
    hessian_.setIdentity();
    hessian_ *= kSoftness;
    for (Eigen::Index m = 0; m < pull_.size(); ++m) {
      if (pull_[m] <= lowest_[m] || pull_[m] >= highest_[m]) continue;
      hessian_.noalias() += moment_arms.col(m) * moment_arms.col(m).transpose();
    }
    factor_.compute(hessian_);
    direction_ = -gradient_;
    factor_.solveInPlace(direction_);
    // The dual function is convex: as long as it still falls at the end of the step, the step was
    // not too long. Unlike a test of the function's value this survives rounding.
    const double overshoot = -1e-9 * gradient_.dot(direction_);
    double share = 1.0;
    for (int i = 0; i < kMaxHalvings; ++i, share *= 0.5) {
      trial_ = lambda_ + share * direction_;
      evaluate(moment_arms, torque, trial_);
      if (gradient_.dot(direction_) <= overshoot) break;
    }
    lambda_ = trial_;
  }
  result_.shortfall.noalias() = -(moment_arms * result_.tension);
  result_.shortfall += torque;
  if (!result_.converged) lambda_.setZero();
  return result_;
}

}  // namespace anthrob
