// Periods of an effort along a way: made series are found again, what does not repeat is not.
#include "hypotheses/periods.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "anthrob_core/random.h"

namespace anthrob {
namespace discovery {
namespace {

/// A way and an effort over it, in bins of 20 ms, with noise.
EffortAlongWay along(const std::function<double(double)>& way,
                     const std::function<double(double, double)>& effort, double noise,
                     std::size_t bins = 600) {
  const CounterRandom random(3, 1);
  EffortAlongWay data;
  data.runs = {0};
  for (std::size_t i = 0; i < bins; ++i) {
    const double t = 0.02 * static_cast<double>(i);
    data.position.push_back(way(t));
    data.velocity.push_back((way(t + 1e-4) - way(t - 1e-4)) / 2e-4);
    data.effort.push_back(effort(data.position.back(), data.velocity.back()) +
                          noise * random.normal(i));
  }
  return data;
}

double wave(double number, double x) {
  return std::sin(2.0 * M_PI * number * x + 0.4);
}

TEST(Periods, OfASlowTurnAreFoundWithTheirAmplitudesBesideFriction) {
  const auto data = along([](double t) { return 0.1 * t; },
                          [](double x, double v) {
                            return 0.7 * wave(7, x) + 0.2 * wave(12, x) + 0.1 * wave(84, x) +
                                   (v > 0.0 ? 0.3 : -0.3);
                          },
                          0.05);
  const std::vector<Period> found = find_periods(data, 12, true, {});
  ASSERT_EQ(found.size(), 3u);
  const double numbers[] = {7.0, 12.0, 84.0}, amplitudes[] = {0.7, 0.2, 0.1};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(found[k].number, numbers[k]);
    EXPECT_NEAR(std::hypot(found[k].sine, found[k].cosine), amplitudes[k], 0.02);
    EXPECT_NEAR(std::atan2(found[k].cosine, found[k].sine), 0.4, 0.2);
  }
}

TEST(Periods, OfASlideNeedNoWholeNumberAndTheStrongestAreTaken) {
  const auto data = along(
      [](double t) { return 0.1 * std::sin(0.8 * t); },
      [](double x, double) { return wave(31.4, x) + 0.6 * wave(57.9, x) + 0.4 * wave(90.3, x); },
      0.1);
  const std::vector<Period> found = find_periods(data, 2, false, {});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].number, 31.4, 0.3);
  EXPECT_NEAR(found[1].number, 57.9, 0.5);
}

TEST(Periods, NothingIsFoundWhereNothingRepeats) {
  const auto turn = [](double t) { return 0.1 * t; };
  const auto swing = [](double t) { return 0.4 * std::sin(1.3 * t) + 0.2 * std::sin(0.4 * t); };
  const auto none = [](double, double) { return 0.0; };
  EXPECT_TRUE(find_periods(along(turn, none, 1.0), 12, true, {}).empty());
  EXPECT_TRUE(find_periods(along(swing, none, 1.0), 12, true, {}).empty());
  // Other laws of a motion are not taken for periods.
  const auto friction = [](double x, double v) {
    return std::copysign(1.0, v) + 0.5 * std::tanh(20.0 * v) + 0.3 * v + 0.2 * x;
  };
  EXPECT_TRUE(find_periods(along(swing, friction, 0.02), 12, true, {}).empty());
  EXPECT_TRUE(find_periods(along([](double) { return 0.3; }, none, 1.0), 12, true, {}).empty());
  EXPECT_TRUE(find_periods({}, 12, true, {}).empty());
}

TEST(Periods, AFastStartDoesNotHideThem) {
  const auto data =
      along([](double t) { return t < 0.2 ? 5.0 * t - 1.0 : 0.1 * (t - 0.2); },
            [](double x, double v) { return (v > 1.0 ? 30.0 : 0.0) + wave(7, x); }, 0.1);
  const std::vector<Period> found = find_periods(data, 12, true, {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].number, 7.0);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
