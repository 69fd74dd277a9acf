#pragma once

#include <Eigen/Core>
#include <array>

namespace anthrob::reference {

/// Autonomous differential equation dx/dt = rate(x) with a part A of its Jacobian that is stiff.
class StiffSystem {
 public:
  virtual ~StiffSystem() = default;
  virtual void rate(const Eigen::VectorXd& x, Eigen::VectorXd* dx) = 0;
  /// rate(x), and prepares solve() for A at this x.
  virtual void rate_and_prepare(const Eigen::VectorXd& x, double shift, Eigen::VectorXd* dx) = 0;
  /// w <- (shift I - A)^-1 w
  virtual void solve(Eigen::VectorXd* w) const = 0;
};

/// One-step method ROS34PW2 (J. Rang, L. Angermann, BIT 45, 2005): four stages, L-stable, and of
/// order 3 for *any* A. So A has to hold only what is too stiff for an explicit method of this
/// cost; with A = 0 it is an explicit Runge-Kutta method.
class Rosenbrock final {
 public:
  void step(double h, StiffSystem* system, Eigen::VectorXd* x);

 private:
  static constexpr int kStages = 4;
  Eigen::VectorXd stage_;
  std::array<Eigen::VectorXd, kStages> u_;
};

}  // namespace anthrob::reference
