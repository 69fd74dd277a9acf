#include "anthrob_reference/rosenbrock.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scalar_system.h"

namespace anthrob::reference {
namespace {

// dx/dt = 1 + x^2 from 0: x = tan t.
double error_at_one(int steps, double jacobian) {
  ScalarSystem system([](double x) { return 1.0 + x * x; }, jacobian);
  double x = 0.0;
  for (int k = 0; k < steps; ++k) x = system.step(1.0 / steps);
  return std::abs(x - std::tan(1.0));
}

TEST(Rosenbrock, IsOfOrderThreeForAnyJacobian) {
  for (const double jacobian : {0.0, 1.0, -5.0}) {
    const double order = std::log2(error_at_one(200, jacobian) / error_at_one(400, jacobian));
    EXPECT_GT(order, 2.9) << jacobian;
  }
}

TEST(Rosenbrock, StiffPartDiesAtOnceAndLeavesTheEquilibrium) {
  ScalarSystem system([](double x) { return -1e8 * (x - 3.0); }, -1e8);
  EXPECT_NEAR(system.step(1e-3), 3.0, 1e-4);
  EXPECT_NEAR(system.step(1e-3), 3.0, 1e-8);
}

}  // namespace
}  // namespace anthrob::reference
