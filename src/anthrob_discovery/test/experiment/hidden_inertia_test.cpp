#include "experiment/hidden_inertia.h"

#include <gtest/gtest.h>

#include <cmath>

namespace anthrob {
namespace discovery {
namespace {

/// An effort that 0.3 times the model's inertial one explains, but for what is beside it.
std::vector<InertialBin> bins(double model, double half_range) {
  std::vector<InertialBin> list;
  for (int i = 0; i < 40; ++i) {
    const double acceleration = std::sin(0.7 * i), beside = 0.1 * std::cos(1.9 * i);
    const double lacking = model * acceleration - 0.3 * acceleration + beside;
    list.push_back({model * acceleration, lacking - half_range, lacking + half_range});
  }
  return list;
}

TEST(HiddenInertia, IsThatOfLeastSquares) {
  for (const double model : {1e-4, 1.0, 1e4}) {
    const auto list = bins(model, 0.0);
    double up = 0.0, down = 0.0;
    for (int i = 0; i < 40; ++i) {
      const double a = std::sin(0.7 * i);
      up += a * (0.3 * a - 0.1 * std::cos(1.9 * i));
      down += a * a;
    }
    EXPECT_NEAR(best_factor(list, {}) * model, up / down, 1e-6) << model;
  }
}

TEST(HiddenInertia, LeavesNoLessBesideIt) {
  const auto list = bins(5.0, 0.05);
  const auto left = [&](double factor) {
    double sum = 0.0;
    for (const InertialBin& bin : list) {
      const double more = (factor - 1.0) * bin.inertial;
      sum += std::pow(beyond_zero(bin.low + more, bin.high + more), 2);
    }
    return sum;
  };
  const double best = best_factor(list, {});
  EXPECT_GT(left(best), 0.0);
  for (const double other : {0.5, 0.9, 0.99, 1.01, 1.1, 2.0}) {
    EXPECT_LT(left(best), left(other * best)) << other;
  }
}

TEST(HiddenInertia, IsNeverNegative) {
  EXPECT_EQ(best_factor({{1.0, 3.0, 3.0}, {2.0, 5.0, 5.0}}, {}), 0.0);
  EXPECT_EQ(best_factor({{0.0, 3.0, 3.0}}, {}), 1.0);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
