#include "scope/decimation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "anthrob_core/testing/random.h"

namespace anthrob {
namespace {

constexpr Nanoseconds kStep = 2000000;

std::vector<Sample> noise(int count, unsigned seed) {
  testing_support::Random random(seed);
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) samples.push_back({i * kStep, random.uniform(-1.0, 1.0)});
  return samples;
}

TEST(DecimationTest, KeepsTheExtremesOfEachColumn) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto samples = noise(30000, seed);
    const int columns = 100 + static_cast<int>(seed) * 37;
    const Nanoseconds end = 30000 * kStep;
    const auto drawn = decimated(SampleSpan(samples), 0, end, columns);
    EXPECT_LE(drawn.size(), 2U * static_cast<unsigned>(columns));
    const double width = static_cast<double>(end) / columns;
    std::vector<double> least(columns, HUGE_VAL), greatest(columns, -HUGE_VAL),
        drawn_least = least, drawn_greatest = greatest;
    const auto column_of = [&](Nanoseconds t) {
      int column = 0;
      while (column + 1 < columns && t >= static_cast<Nanoseconds>(width * (column + 1))) ++column;
      return column;
    };
    for (std::size_t i = 0; i < samples.size(); i += 7) {
      // A seventh of all is enough to see a lost one; the drawn ones must reach at least as far.
      const int c = column_of(samples[i].t);
      least[c] = std::min(least[c], samples[i].value),
      greatest[c] = std::max(greatest[c], samples[i].value);
    }
    for (const Sample& sample : drawn) {
      const int c = column_of(sample.t);
      drawn_least[c] = std::min(drawn_least[c], sample.value);
      drawn_greatest[c] = std::max(drawn_greatest[c], sample.value);
    }
    for (int c = 0; c < columns; ++c) {
      ASSERT_LE(drawn_least[c], least[c]);
      ASSERT_GE(drawn_greatest[c], greatest[c]);
    }
  }
}

TEST(DecimationTest, APeakOfOneSampleIsDrawn) {
  auto samples = noise(30000, 1);
  samples[12345].value = 50.0;
  const auto drawn = decimated(SampleSpan(samples), 0, 30000 * kStep, 500);
  const auto peak =
      std::max_element(drawn.begin(), drawn.end(),
                       [](const Sample& a, const Sample& b) { return a.value < b.value; });
  EXPECT_EQ(peak->value, 50.0);
  EXPECT_EQ(peak->t, samples[12345].t);
}

TEST(DecimationTest, IsInTheOrderOfTimeAndReachesTheEdges) {
  const auto samples = noise(30000, 2);
  const Nanoseconds begin = 5000 * kStep + 1, end = 25000 * kStep + 1;
  const auto drawn = decimated(SampleSpan(samples), begin, end, 300);
  EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end(),
                             [](const Sample& a, const Sample& b) { return a.t < b.t; }));
  EXPECT_EQ(drawn.front().t, 5000 * kStep);
  EXPECT_EQ(drawn.back().t, 25001 * kStep);
}

TEST(DecimationTest, FewSamplesStayAsTheyAre) {
  const auto samples = noise(100, 3);
  EXPECT_EQ(decimated(SampleSpan(samples), -kStep, 200 * kStep, 50).size(), 100U);
  EXPECT_TRUE(decimated(SampleSpan(), 0, kStep, 50).empty());
  EXPECT_TRUE(decimated(SampleSpan(samples), kStep, kStep, 50).empty());
}

TEST(DecimationTest, AGapStaysAGap) {
  auto samples = noise(30000, 4);
  for (std::size_t i = 10000; i < 20000; ++i) samples[i].value = std::nan("");
  const auto drawn = decimated(SampleSpan(samples), 0, 30000 * kStep, 300);
  const auto is_gap = [](const Sample& sample) { return std::isnan(sample.value); };
  EXPECT_GE(std::count_if(drawn.begin(), drawn.end(), is_gap), 99);
}

}  // namespace
}  // namespace anthrob
