#include "experiment/packed_differences.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "anthrob_core/random.h"

namespace anthrob {
namespace discovery {
namespace packed_differences_test {
namespace {

/// Multiples of a step: a curve, and noise of another stream for each seed.
Eigen::VectorXf rounded_series(Eigen::Index count, double amplitude, double noise, double step,
                               std::uint64_t seed) {
  const CounterRandom random(seed, 1);
  Eigen::VectorXf series(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double value = amplitude * std::sin(0.01 * static_cast<double>(i)) +
                         noise * random.normal(static_cast<std::uint64_t>(i));
    series[i] = static_cast<float>(step * std::nearbyint(value / step));
  }
  return series;
}

void expect_same_bits(const Eigen::VectorXf& numbers, const Eigen::VectorXf& reference) {
  const Eigen::VectorXf again = unpacked(packed(numbers, reference), reference);
  ASSERT_EQ(again.size(), numbers.size());
  for (Eigen::Index i = 0; i < numbers.size(); ++i) EXPECT_EQ(again[i], numbers[i]) << i;
}

TEST(PackedDifferences, ComeBackBitForBit) {
  const double step = std::ldexp(1.0, -12);
  const Eigen::VectorXf numbers = rounded_series(1000, 3.0, 0.1, step, 1);
  expect_same_bits(numbers, {});
  expect_same_bits(numbers, rounded_series(1000, 3.0, 0.1, step, 2));
  expect_same_bits(numbers, rounded_series(1000, 3.0, 0.1, 0.3, 3));  // of another step
  expect_same_bits(numbers, 1e30f * numbers);
  expect_same_bits({}, {});
  expect_same_bits(Eigen::VectorXf::Zero(300), {});
}

TEST(PackedDifferences, OfAnyNumbersComeBackBitForBit) {
  using Limits = std::numeric_limits<float>;
  Eigen::VectorXf numbers = rounded_series(600, 3.0, 0.1, 1e-9, 4);
  expect_same_bits(numbers, numbers);
  numbers[0] = Limits::max();
  numbers[1] = Limits::lowest();
  numbers[2] = Limits::denorm_min();
  numbers[300] = -Limits::min();
  numbers[301] = 1.0f;
  expect_same_bits(numbers, {});
  expect_same_bits(numbers, rounded_series(600, 3.0, 0.1, 0.01, 5));
}

TEST(PackedDifferences, NearAReferenceTakeLessThanAByteEach) {
  const double noise = 0.5, step = std::ldexp(1.0, -11);
  const Eigen::VectorXf one = rounded_series(10000, 2.0, noise, step, 6);
  // A smooth change of half the noise, as by a parameter.
  const Eigen::VectorXf change = rounded_series(10000, 0.5 * noise, 0.0, step, 7);
  const auto size = static_cast<double>(packed(one + change, one).size());
  EXPECT_LT(size, 0.75 * 10000);
  EXPECT_GT(static_cast<double>(packed(one, {}).size()), 2.0 * size);
}

TEST(PackedDifferences, AreRoundedFarBelowTheNoise) {
  const CounterRandom random(1, 1);
  std::vector<double> rows;
  const double noise = 0.3;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    rows.push_back(2.0 * std::sin(0.002 * static_cast<double>(i)) + noise * random.normal(i));
  }
  const double rounding = rounding_of(rows, 4.0, 1e-3), in_a_bin = 0.5 * noise;
  EXPECT_LE(rounding, 1.05e-3 * in_a_bin);
  EXPECT_GE(rounding, 0.45e-3 * in_a_bin);
  EXPECT_EQ(rounding, std::ldexp(1.0, std::ilogb(rounding)));
  EXPECT_EQ(rounding_of(std::vector<double>(100, 1.5), 4.0, 1e-3), 0.0);
  EXPECT_EQ(rounding_of({1.0, 2.0}, 4.0, 1e-3), 0.0);
}

}  // namespace
}  // namespace packed_differences_test
}  // namespace discovery
}  // namespace anthrob
