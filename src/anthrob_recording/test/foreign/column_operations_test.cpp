#include "foreign/column_operations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace anthrob {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Uneven times, about 10 ms apart.
std::vector<double> uneven(std::size_t n) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> step(0.002, 0.02);
  std::vector<double> t = {0.0};
  while (t.size() < n) t.push_back(t.back() + step(engine));
  return t;
}

double parabola(double t) {
  return 2.0 - 3.0 * t + 5.0 * t * t;
}

TEST(ColumnOperations, DerivativesOfParabolasAreExactWhateverTheSpacing) {
  const std::vector<double> t = uneven(50);
  std::vector<double> v;
  for (const double x : t) v.push_back(parabola(x));
  v[7] = kNone, v[20] = v[21] = kNone, v[49] = kNone;
  const std::vector<double> slope = derivative_of(t, v);
  const LocalFit fit = fit_locally(t, v, 0.08);
  for (std::size_t i = 0; i < t.size(); ++i) {
    ASSERT_EQ(std::isfinite(slope[i]), std::isfinite(v[i])) << i;
    ASSERT_EQ(std::isfinite(fit.value[i]), std::isfinite(v[i])) << i;
    if (!std::isfinite(v[i])) continue;
    EXPECT_NEAR(slope[i], -3.0 + 10.0 * t[i], 1e-10) << i;
    EXPECT_NEAR(fit.slope[i], -3.0 + 10.0 * t[i], 1e-9) << i;
    EXPECT_NEAR(fit.value[i], v[i], 1e-12) << i;
  }
}

TEST(ColumnOperations, SmoothingAveragesNoiseByTheFactorOfSavitzkyAndGolay) {
  // The centre of a parabola over 2 m + 1 even samples keeps a variance of
  // 3 (3 m^2 + 3 m - 1) / ((2 m - 1) (2 m + 1) (2 m + 3)) of white noise.
  const int m = 10;
  const double left =
      3.0 * (3.0 * m * m + 3.0 * m - 1.0) / ((2.0 * m - 1.0) * (2.0 * m + 1.0) * (2.0 * m + 3.0));
  std::vector<double> t, impulse(101, 0.0);
  for (int i = 0; i < 101; ++i) t.push_back(0.001 * i);
  impulse[50] = 1.0;  // what it leaves at the others are the weights
  const LocalFit fit = fit_locally(t, impulse, 0.001 * 2 * m);
  EXPECT_EQ(fit.most, 2u * m + 1u);
  double sum = 0.0, square = 0.0;
  for (const double weight : fit.value) sum += weight, square += weight * weight;
  EXPECT_NEAR(sum, 1.0, 1e-9);
  EXPECT_NEAR(square, left, 1e-9);
}

TEST(ColumnOperations, TrapezoidsUndoSlopesOfLines) {
  const std::vector<double> t = uneven(40);
  std::vector<double> v;
  for (const double x : t) v.push_back(1.0 + 2.0 * x);
  v[0] = kNone, v[10] = kNone;
  const std::vector<double> sum = integral_of(t, v, 7.0);
  EXPECT_FALSE(std::isfinite(sum[0]));
  EXPECT_FALSE(std::isfinite(sum[10]));
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (i == 10) continue;
    EXPECT_NEAR(sum[i], 7.0 + (t[i] + t[i] * t[i]) - (t[1] + t[1] * t[1]), 1e-12) << i;
  }
}

TEST(ColumnOperations, CountersThatWrapAreMadeContinuous) {
  EXPECT_EQ(unwrapped({4090, 4095, kNone, 3, 10, 4094}, 4096)[3], 4099);
  EXPECT_EQ(unwrapped({4090, 4095, kNone, 3, 10, 4094}, 4096)[5], 4094);
  EXPECT_EQ(unwrapped({350, 10, 170, 340, 130}, 360),
            (std::vector<double>{350, 370, 530, 700, 850}));
}

TEST(ColumnOperations, FreshIsWhereTheMarkChanges) {
  const std::vector<double> v = {1, 1, 2, 2, 2, 3};
  const std::vector<double> own = fresh_of(v, v), frames = fresh_of(v, {1, 1, kNone, 1, 2, 2});
  const auto rows = [](const std::vector<double>& list) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < list.size(); ++i)
      if (std::isfinite(list[i])) found.push_back(i);
    return found;
  };
  EXPECT_EQ(rows(own), (std::vector<std::size_t>{0, 2, 5}));
  EXPECT_EQ(rows(frames), (std::vector<std::size_t>{0, 4}));
}

}  // namespace
}  // namespace anthrob
