// Fits and their intervals against closed forms and against what they promise.
#include "identification/least_squares.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/random.h"

namespace anthrob {
namespace identification {
namespace {

/// y = a + b x at x = 0 .. n-1.
LeastSquares line(const std::vector<double>& y) {
  LeastSquares problem;
  problem.residual_count = y.size();
  problem.parameters = {{0.0, 1.0, -1e9, 1e9}, {0.0, 0.01, -1e9, 1e9}};
  problem.evaluate = [&y](const double* p, double* r, double* j) {
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double x = static_cast<double>(i);
      r[i] = p[0] + p[1] * x - y[i];
      if (j) j[2 * i] = 1.0, j[2 * i + 1] = x;
    }
  };
  return problem;
}

TEST(LeastSquares, StraightLineHasItsClosedForm) {
  const std::vector<double> y = {1.0, 3.5, 4.5, 7.0};
  const Fit fit = solve(line(y));
  // Sums: x 6, xx 14, y 16, xy 33.5.
  EXPECT_NEAR(fit.values[1], (4 * 33.5 - 6 * 16) / (4.0 * 14 - 36), 1e-6);
  EXPECT_NEAR(fit.values[0], (16 - fit.values[1] * 6) / 4, 1e-6);
  double squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    squares += std::pow(fit.values[0] + fit.values[1] * static_cast<double>(i) - y[i], 2);
  }
  EXPECT_NEAR(fit.covariance(1, 1), squares / 2.0 * 4.0 / 20.0, 1e-6);
  EXPECT_NEAR(fit.covariance(0, 1), -squares / 2.0 * 6.0 / 20.0, 1e-6);
  EXPECT_EQ(fit.freedom, 2);
  EXPECT_NEAR(fit.deviation, std::sqrt(squares / 4.0), 1e-6);
  // Student's quantile for two degrees of freedom.
  EXPECT_NEAR(fit.estimate(1).hi - fit.values[1], 4.302653 * std::sqrt(fit.covariance(1, 1)), 1e-6);
}

TEST(LeastSquares, IntervalsHoldForCorrelatedNoise) {
  // Noise like that of a filtered force sensor: a moving average over 20 samples.
  constexpr int kRows = 2000, kTrials = 300;
  int covered_blocks = 0, covered_plain = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const CounterRandom random(7, static_cast<std::uint64_t>(trial));
    std::vector<double> y(kRows);
    for (int i = 0; i < kRows; ++i) {
      y[static_cast<std::size_t>(i)] = 2.0 + 0.001 * i;
      for (int k = 0; k < 20; ++k) {
        y[static_cast<std::size_t>(i)] += random.normal(static_cast<std::uint64_t>(i + k)) / 20.0;
      }
    }
    LeastSquares problem = line(y);
    const auto covers = [&] {
      const Estimate slope = solve(problem).estimate(1);
      return slope.lo <= 0.001 && 0.001 <= slope.hi ? 1 : 0;
    };
    covered_plain += covers();
    for (int i = 0; i < kRows; ++i) problem.block.push_back(i / 100);
    covered_blocks += covers();
  }
  EXPECT_GT(covered_blocks, 0.90 * kTrials);
  EXPECT_LT(covered_blocks, 0.99 * kTrials);
  EXPECT_LT(covered_plain, 0.60 * kTrials);  // what the correction is for
}

TEST(LeastSquares, FindsTheMinimumOfACurvedValley) {
  // Rosenbrock: residuals 10 (y - x^2), 1 - x and one that keeps a degree of freedom.
  LeastSquares problem;
  problem.residual_count = 3;
  problem.parameters = {{-1.2, 1.0, -10.0, 10.0}, {1.0, 1.0, -10.0, 10.0}};
  problem.evaluate = [](const double* p, double* r, double* j) {
    r[0] = 10.0 * (p[1] - p[0] * p[0]);
    r[1] = 1.0 - p[0];
    r[2] = 0.0;
    if (!j) return;
    const double rows[] = {-20.0 * p[0], 10.0, -1.0, 0.0, 0.0, 0.0};
    std::copy(rows, rows + 6, j);
  };
  const Fit fit = solve(problem);
  EXPECT_NEAR(fit.values[0], 1.0, 1e-8);
  EXPECT_NEAR(fit.values[1], 1.0, 1e-8);
}

TEST(LeastSquares, SaysWhatCannotBeFitted) {
  const std::vector<double> two = {1.0, 2.0};
  EXPECT_THROW(solve(line(two)), std::runtime_error);
  LeastSquares twins;
  twins.residual_count = 5;
  twins.parameters = {{0.0, 1.0, -9.0, 9.0}, {0.0, 1.0, -9.0, 9.0}};
  twins.evaluate = [](const double* p, double* r, double* j) {
    for (int i = 0; i < 5; ++i) {
      r[i] = p[0] + p[1] - i;
      if (j) j[2 * i] = j[2 * i + 1] = 1.0;
    }
  };
  try {
    solve(twins);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("distinguish the parameters"), std::string::npos);
  }
}

TEST(Estimate, MeanOfSeries) {
  const Estimate mean = mean_of_series({1, 1, 3, 3, 2, 2}, 2);
  EXPECT_DOUBLE_EQ(mean.value, 2.0);
  EXPECT_NEAR(mean.sigma, 1.0 / std::sqrt(3.0), 1e-12);
  EXPECT_THROW(mean_of_series({1, 2, 3}, 2), std::invalid_argument);
}

TEST(Estimate, IndependentErrorsAddUp) {
  const Estimate wide = widened(make_estimate(5.0, 0.3, 1e6), 0.4);
  EXPECT_NEAR(wide.sigma, 0.5, 1e-12);
  EXPECT_NEAR(wide.hi, 5.0 + 1.96 * 0.5, 1e-3);
}

}  // namespace
}  // namespace identification
}  // namespace anthrob
