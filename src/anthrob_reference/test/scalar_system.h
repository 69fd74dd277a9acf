#pragma once

#include <functional>
#include <utility>

#include "anthrob_reference/rosenbrock.h"

namespace anthrob::reference {

/// dx/dt = rate(x) in one variable, from 0, with a guess of its Jacobian.
class ScalarSystem final : public StiffSystem {
 public:
  explicit ScalarSystem(std::function<double(double)> rate, double jacobian = 0.0)
      : rate_(std::move(rate)), jacobian_(jacobian), x_(Eigen::VectorXd::Zero(1)) {}

  double step(double h) {
    integrator_.step(h, this, &x_);
    return x_(0);
  }

  void rate(const Eigen::VectorXd& x, Eigen::VectorXd* dx) override {
    dx->setConstant(1, rate_(x(0)));
  }
  void rate_and_prepare(const Eigen::VectorXd& x, double shift, Eigen::VectorXd* dx) override {
    rate(x, dx);
    shift_ = shift;
  }
  void solve(Eigen::VectorXd* w) const override { *w /= shift_ - jacobian_; }

 private:
  std::function<double(double)> rate_;
  double jacobian_;
  double shift_ = 0.0;
  Eigen::VectorXd x_;
  Rosenbrock integrator_;
};

}  // namespace anthrob::reference
