// Minima of quadratic forms between bounds.
#include "fit/bounded_minimum.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cstdint>

#include "anthrob_core/random.h"

namespace anthrob {
namespace discovery {
namespace {

TEST(BoundedMinimum, IsTheFreeOneInsideAndSatisfiesOptimalityAtBounds) {
  const CounterRandom random(3, 1);
  std::uint64_t n = 0;
  for (int round = 0; round < 50; ++round) {
    Eigen::MatrixXd root(6, 6);
    Eigen::VectorXd g(6);
    for (int i = 0; i < 6; ++i) {
      g[i] = random.normal(n++);
      for (int j = 0; j < 6; ++j) root(i, j) = random.normal(n++);
    }
    const Eigen::MatrixXd A = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(6, 6);
    const Eigen::VectorXd wide = Eigen::VectorXd::Constant(6, 1e6);
    EXPECT_LT((bounded_minimum(A, g, -wide, wide) + A.ldlt().solve(g)).norm(), 1e-8);
    const Eigen::VectorXd lower = Eigen::VectorXd::Constant(6, -0.2), upper = -0.5 * lower;
    const Eigen::VectorXd x = bounded_minimum(A, g, lower, upper), gradient = A * x + g;
    for (int i = 0; i < 6; ++i) {
      EXPECT_GE(x[i], lower[i]);
      EXPECT_LE(x[i], upper[i]);
      if (x[i] == lower[i]) {
        EXPECT_GE(gradient[i], -1e-7);
      } else if (x[i] == upper[i]) {
        EXPECT_LE(gradient[i], 1e-7);
      } else {
        EXPECT_NEAR(gradient[i], 0.0, 1e-7);
      }
    }
  }
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
