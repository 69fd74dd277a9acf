#include "scope/series_difference.h"

#include <gtest/gtest.h>

#include <cmath>

namespace anthrob {
namespace {

template <class Function>
std::vector<Sample> series_of(Nanoseconds begin, Nanoseconds step, int count, Function value) {
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    const Nanoseconds t = begin + i * step;
    samples.push_back({t, value(1e-9 * static_cast<double>(t))});
  }
  return samples;
}

TEST(ComparisonTest, AConstantOffsetIsTheRms) {
  const auto a = series_of(0, 2000000, 1000, [](double t) { return std::sin(t); });
  auto b = a;
  for (Sample& sample : b) sample.value += 0.25;
  const auto comparison = difference_between(SampleSpan(a), SampleSpan(b), 0);
  ASSERT_TRUE(comparison);
  EXPECT_EQ(comparison->difference.size(), 1000U);
  EXPECT_NEAR(comparison->rms, 0.25, 1e-15);
  EXPECT_NEAR(comparison->largest, 0.25, 1e-15);
  EXPECT_LT(difference_between(SampleSpan(b), SampleSpan(a), 0)->difference.front().value, 0.0);
}

TEST(ComparisonTest, OfASineOverWholePeriodsItIsItsAmplitudeByRootTwo) {
  const auto zero = series_of(0, 1000000, 3000, [](double) { return 0.0; });
  const auto sine =
      series_of(0, 1000000, 3000, [](double t) { return 3.0 * std::sin(2.0 * M_PI * t); });
  EXPECT_NEAR(difference_between(SampleSpan(zero), SampleSpan(sine), 0)->rms, 3.0 / std::sqrt(2.0),
              1e-12);
}

TEST(ComparisonTest, InterpolatesOtherRatesAndShiftedTimes) {
  const auto line = [](double t) { return 2.0 * t + 1.0; };
  const auto a = series_of(0, 2000000, 1000, line);
  const auto b = series_of(500000, 7000000, 300, line);
  EXPECT_NEAR(difference_between(SampleSpan(a), SampleSpan(b), 0)->largest, 0.0, 1e-12);
  // Half a second later, a line of slope 2 is lower by 1.
  EXPECT_NEAR(difference_between(SampleSpan(a), SampleSpan(b), 500000000)->rms, 1.0, 1e-12);
}

TEST(ComparisonTest, TakesTheCommonTimeOnly) {
  const auto one = [](double) { return 1.0; };
  const auto a = series_of(0, 1000000, 1000, one), b = series_of(900000000, 1000000, 1000, one);
  const auto comparison = difference_between(SampleSpan(a), SampleSpan(b), 0);
  ASSERT_TRUE(comparison);
  EXPECT_EQ(comparison->difference.size(), 100U);
  EXPECT_FALSE(difference_between(SampleSpan(a), SampleSpan(b), 200000000));
  EXPECT_FALSE(difference_between(SampleSpan(a), SampleSpan(), 0));
}

TEST(ComparisonTest, LeavesOutWhatWasNotMeasured) {
  auto a = series_of(0, 1000000, 100, [](double) { return 0.0; });
  auto b = series_of(0, 1000000, 100, [](double) { return 2.0; });
  a[10].value = std::nan("");
  b[20].value = std::nan("");
  const auto comparison = difference_between(SampleSpan(a), SampleSpan(b), 0);
  ASSERT_TRUE(comparison);
  EXPECT_EQ(comparison->difference.size(), 98U);
  EXPECT_EQ(comparison->rms, 2.0);
  EXPECT_FALSE(value_at(SampleSpan(b), 20500000));
  EXPECT_EQ(value_at(SampleSpan(b), 21500000), 2.0);
}

}  // namespace
}  // namespace anthrob
