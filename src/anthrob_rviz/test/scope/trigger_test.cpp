#include "scope/trigger.h"

#include <gtest/gtest.h>

#include <cmath>

namespace anthrob {
namespace {

constexpr Nanoseconds kSecond = 1000000000;

/// A triangle of period 2 s between -1 and 1 that rises through 0 at 0.5 s, 2.5 s, ...
std::vector<Sample> triangle(double until) {
  std::vector<Sample> samples;
  for (int i = 0; i * 0.01 <= until; ++i) {
    const double phase = std::fmod(i * 0.01, 2.0);
    samples.push_back({i * (kSecond / 100), phase < 1.0 ? 2.0 * phase - 1.0 : 3.0 - 2.0 * phase});
  }
  return samples;
}

Trigger trigger(double level, Trigger::Edge edge) {
  Trigger result;
  result.level = level, result.edge = edge;
  return result;
}

TEST(TriggerTest, FindsTheLastCrossingOfEachEdge) {
  const auto samples = triangle(4.0);
  const auto rising = last_sweep(SampleSpan(samples), trigger(0.005, Trigger::Edge::kRising));
  ASSERT_TRUE(rising);
  EXPECT_NEAR(1e-9 * static_cast<double>(rising->crossing), 2.5025, 1e-9);
  EXPECT_EQ(rising->crossing - rising->begin, kSecond / 5);
  EXPECT_EQ(rising->end - rising->begin, kSecond);
  // The one at 3.5 s would end at 4.3 s.
  const auto falling = last_sweep(SampleSpan(samples), trigger(0.005, Trigger::Edge::kFalling));
  ASSERT_TRUE(falling);
  EXPECT_NEAR(1e-9 * static_cast<double>(falling->crossing), 1.4975, 1e-9);
  EXPECT_EQ(last_sweep(SampleSpan(samples), trigger(0.005, Trigger::Edge::kEither))->crossing,
            rising->crossing);
}

TEST(TriggerTest, WaitsUntilThePictureIsComplete) {
  const auto all = triangle(3.4);
  const SampleSpan complete(all.data(), all.data() + 331), early(all.data(), all.data() + 330);
  EXPECT_GT(last_sweep(complete, trigger(0.0, Trigger::Edge::kRising))->crossing, 2 * kSecond);
  EXPECT_LT(last_sweep(early, trigger(0.0, Trigger::Edge::kRising))->crossing, kSecond);
}

TEST(TriggerTest, NothingCrosses) {
  auto samples = triangle(4.0);
  EXPECT_FALSE(last_sweep(SampleSpan(samples), trigger(1.5, Trigger::Edge::kEither)));
  EXPECT_FALSE(last_sweep(SampleSpan(), trigger(0.0, Trigger::Edge::kEither)));
  for (std::size_t i = 0; i < samples.size(); i += 2) samples[i].value = std::nan("");
  EXPECT_FALSE(last_sweep(SampleSpan(samples), trigger(0.0, Trigger::Edge::kEither)));
}

TEST(TriggerTest, ASampleOnTheLevelIsOneCrossing) {
  const std::vector<Sample> samples = {
      {0, -1.0}, {kSecond, 0.0}, {2 * kSecond, 1.0}, {5 * kSecond, 1.0}};
  const auto sweep = last_sweep(SampleSpan(samples), trigger(0.0, Trigger::Edge::kRising));
  ASSERT_TRUE(sweep);
  EXPECT_EQ(sweep->crossing, kSecond);
}

}  // namespace
}  // namespace anthrob
