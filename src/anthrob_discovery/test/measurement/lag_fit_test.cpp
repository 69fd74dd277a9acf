// A made-up quantity, measured late or through a filter.
#include "measurement/lag_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/random.h"

namespace anthrob {
namespace discovery {
namespace lag_fit_test {

const double kSlow = 6.0, kFast = 40.0;  // [rad/s]

double expected(double t) {
  return std::sin(kSlow * t) + 0.4 * std::sin(kFast * t);
}
/// What is left of it behind a filter of first order, once its beginning is forgotten.
double filtered(double t, double tau) {
  const auto part = [&](double amplitude, double rate) {
    return amplitude / std::hypot(1.0, rate * tau) * std::sin(rate * t - std::atan(rate * tau));
  };
  return part(1.0, kSlow) + part(0.4, kFast);
}

template <typename Value>
LaggingPair pair_of(const Value& value, std::uint64_t seed) {
  LaggingPair pair;
  const CounterRandom random(seed, 1);
  for (int i = 0; i < 6000; ++i) {
    const double t = 0.003 * i;
    pair.expected.t.push_back(t), pair.measured.t.push_back(t);
    pair.expected.values.push_back(expected(t));
    pair.measured.values.push_back(0.2 + 1.2 * value(t) +
                                   0.02 * random.normal(static_cast<std::uint64_t>(i)));
  }
  return pair;
}

TEST(LagFit, FindsALagBelowARow) {
  for (const double late : {-0.02, -0.0013, 0.0, 0.0007, 0.011, 0.0237}) {
    const auto value = [&](double t) { return expected(t - late); };
    const auto fit = fit_lag({pair_of(value, 1), pair_of(value, 2)}, 0.025, {});
    ASSERT_TRUE(fit) << late;
    EXPECT_NEAR(fit->late, late, 4.0 * fit->sigma + 2e-5);
    EXPECT_LT(fit->sigma, 2e-4);
  }
}

TEST(LagFit, TellsAFilterFromADelay) {
  const auto delayed = [](double t) { return expected(t - 0.009); };
  const auto smooth = [](double t) { return filtered(t, 0.009); };
  const std::vector<LaggingPair> late = {pair_of(delayed, 1)}, slow = {pair_of(smooth, 1)};
  const auto filter = fit_filter(slow, 0.025, {});
  ASSERT_TRUE(filter);
  EXPECT_NEAR(filter->late, 0.009, 6e-4);
  EXPECT_LT(filter->squares, fit_lag(slow, 0.025, {})->squares);
  EXPECT_GT(fit_filter(late, 0.025, {})->squares, fit_lag(late, 0.025, {})->squares);
}

TEST(LagFit, NeedsPairsAndTime) {
  EXPECT_FALSE(fit_lag({}, 0.025, {}));
  LaggingPair brief = pair_of(expected, 1);
  for (Series* series : {&brief.measured, &brief.expected}) {
    series->t.resize(500), series->values.resize(500);
  }
  EXPECT_FALSE(fit_lag({brief}, 0.025, {}));
}

}  // namespace lag_fit_test
}  // namespace discovery
}  // namespace anthrob
