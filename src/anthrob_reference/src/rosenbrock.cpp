#include "anthrob_reference/rosenbrock.h"

#include <Eigen/LU>

namespace anthrob::reference {
namespace {

using Matrix4 = Eigen::Matrix4d;

constexpr double kGamma = 4.3586652150845900e-01;

// Coefficients for stages u = sum Gamma k, which need no products with A (E. Hairer, G. Wanner,
// Solving Ordinary Differential Equations II, section IV.7).
struct Tableau {
  Matrix4 a;             // argument of stage i: x + sum a(i, j) u_j
  Matrix4 c;             // right side of stage i: rate + sum c(i, j) u_j / h
  Eigen::RowVector4d m;  // new x: x + sum m(j) u_j
};

Tableau make_tableau() {
  Matrix4 alpha = Matrix4::Zero();
  alpha(1, 0) = 8.7173304301691801e-01;
  alpha.row(2).head<2>() << 8.4457060015369423e-01, -1.1299064236484185e-01;
  alpha(3, 2) = 1.0;
  Matrix4 gamma = kGamma * Matrix4::Identity();
  gamma(1, 0) = -8.7173304301691801e-01;
  gamma.row(2).head<2>() << -9.0338057013044082e-01, 5.4180672388095326e-02;
  gamma.row(3).head<3>() << 2.4212380706095346e-01, -1.2232505839045147e+00, 5.4526025533510214e-01;
  Eigen::RowVector4d b;
  b << 2.4212380706095346e-01, -1.2232505839045147e+00, 1.5452602553351020e+00, kGamma;
  const Matrix4 inverse = gamma.inverse();
  return {alpha * inverse, Matrix4::Identity() / kGamma - inverse, b * inverse};
}

}  // namespace

void Rosenbrock::step(double h, StiffSystem* system, Eigen::VectorXd* x) {
  static const Tableau tableau = make_tableau();
  for (int i = 0; i < kStages; ++i) {
    stage_ = *x;
    for (int j = 0; j < i; ++j) stage_ += tableau.a(i, j) * u_[j];
    if (i == 0) {
      system->rate_and_prepare(stage_, 1.0 / (kGamma * h), &u_[i]);
    } else {
      system->rate(stage_, &u_[i]);
    }
    for (int j = 0; j < i; ++j) u_[i] += (tableau.c(i, j) / h) * u_[j];
    system->solve(&u_[i]);
  }
  for (int j = 0; j < kStages; ++j) *x += tableau.m(j) * u_[j];
}

}  // namespace anthrob::reference
