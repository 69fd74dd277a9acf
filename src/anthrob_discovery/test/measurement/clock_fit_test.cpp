// Stamps of a made-up motion, shifted and stretched.
#include "measurement/clock_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/random.h"

namespace anthrob {
namespace discovery {
namespace clock_fit_test {

double way(double t, int column) {
  return column == 0 ? 0.4 * std::sin(1.7 * t) + 0.2 * std::sin(4.1 * t) : 0.3 * std::cos(2.3 * t);
}

/// Two columns with noise, whose stamps are late by `late` + `drift` (t - middle).
Table measured(double length, double late, double drift) {
  Table table;
  const CounterRandom random(5, 2);
  for (int c = 0; c < 2; ++c) table.column("joint_" + std::to_string(c) + "/position");
  for (int i = 0; i * 0.01 < length; ++i) {
    const double t = 0.01 * i;
    table.t.push_back(static_cast<Nanoseconds>(i) * 10000000);
    for (int c = 0; c < 2; ++c) {
      const double taken = t - late - drift * (t - 0.5 * length);
      auto& column = table.columns[static_cast<std::size_t>(c)];
      column.values.push_back(way(taken, c) +
                              5e-4 * random.normal(static_cast<std::uint64_t>(2 * i + c)));
      column.present.push_back(1);
    }
  }
  return table;
}

/// By a clock that is right; the second column has an offset, as of a sensor.
Table simulated(const Table& like) {
  Table table = like;
  for (std::size_t c = 0; c < 2; ++c) {
    for (std::size_t i = 0; i < table.t.size(); ++i) {
      table.columns[c].values[i] =
          way(seconds(table.t[i]), static_cast<int>(c)) + (c == 1 ? 0.05 : 0.0);
    }
  }
  return table;
}

TEST(ClockFit, FindsLatenessAndDrift) {
  for (const double late : {0.0, 0.004, -0.006}) {
    for (const double drift : {0.0, 8e-5, -1e-4}) {
      const Table table = measured(30.0, late, drift);
      const auto fit = fit_clock(table, simulated(table), {});
      ASSERT_TRUE(fit);
      EXPECT_NEAR(fit->late, late, 4.0 * fit->late_sigma + 1e-4);
      EXPECT_NEAR(fit->drift, drift, 4.0 * fit->drift_sigma);
      EXPECT_LT(fit->late_sigma, 1e-4);
      EXPECT_LT(fit->drift_sigma, 1e-5);
    }
  }
}

TEST(ClockFit, NeedsTimeAndMotion) {
  const Table brief = measured(4.0, 0.004, 0.0);
  EXPECT_FALSE(fit_clock(brief, simulated(brief), {}));
  Table still = measured(30.0, 0.0, 0.0);
  Table other = still;
  for (Column& column : other.columns) {
    std::fill(column.values.begin(), column.values.end(), 0.1);
  }
  EXPECT_FALSE(fit_clock(still, other, {}));
}

}  // namespace clock_fit_test
}  // namespace discovery
}  // namespace anthrob
