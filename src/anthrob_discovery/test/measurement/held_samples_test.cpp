// Sensors that are slower than the rows that hold their values.
#include "measurement/held_samples.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/random.h"

namespace anthrob {
namespace discovery {
namespace {

constexpr double kRows = 200.0;  // [Hz]

/// A joint that a camera sees.
struct Camera {
  double rate = 60.0;  ///< [Hz]
  double late = 0.0;   ///< until a frame arrives [s]
  double count = 0.0;  ///< [rad]; 0: none
  double noise = 1e-4;

  double frame_before(double time) const { return std::floor((time - late) * rate + 1e-9); }

  Table record(double length = 20.0) const {
    Table table;
    table.name = "joints";
    Column& column = table.column("elbow/position");
    const CounterRandom random(1, 2);
    for (std::size_t i = 0; i < static_cast<std::size_t>(length * kRows); ++i) {
      const double time = static_cast<double>(i) / kRows, frame = frame_before(time);
      const double taken = frame / rate;
      double value = 0.5 * std::sin(taken) + 0.2 * std::sin(2.7 * taken) +
                     noise * random.normal(static_cast<std::uint64_t>(frame + 100.0));
      if (count > 0.0) value = count * std::round(value / count);
      table.t.push_back(static_cast<Nanoseconds>(std::llround(1e9 * time)));
      column.values.push_back(value);
      column.present.push_back(1);
    }
    return table;
  }
};

std::optional<HeldSamples> held_in(const Table& table) {
  return find_held(table, {"elbow/position"}, {});
}

/// How far the times of fresh rows are from the arrival of their frames, at most [s].
double worst_time(const Camera& camera, const Table& table, const HeldSamples& held) {
  double worst = 0.0;
  for (std::size_t i = 0; i < held.taken.size(); ++i) {
    if (!held.taken[i]) continue;
    const double arrival = camera.frame_before(seconds(table.t[i])) / camera.rate + camera.late;
    worst = std::max(worst, std::abs(seconds(*held.taken[i]) - arrival));
  }
  return worst;
}

TEST(HeldSamples, RateAndTimesOfFramesAreFound) {
  for (const double rate : {15.0, 50.0, 59.94, 60.0, 119.3, 120.0}) {
    const Camera camera{rate};
    const Table table = camera.record();
    const auto held = held_in(table);
    ASSERT_TRUE(held) << rate;
    EXPECT_NEAR(1.0 / held->period, rate, 1e-3 * rate);
    EXPECT_LT(held->uncertainty, 1e-3 * held->period);
    EXPECT_LT(worst_time(camera, table, *held), 2e-4) << rate;
  }
}

TEST(HeldSamples, OfAnotherClockTheBeatTellsWhenFramesArrive) {
  const Camera camera{59.94, 0.003};
  const Table table = camera.record();
  const auto held = held_in(table);
  ASSERT_TRUE(held);
  EXPECT_LT(worst_time(camera, table, *held), 2e-4);
}

TEST(HeldSamples, CountsOfTheSensorLeaveHolesNotErrors) {
  for (const double count : {0.006, 0.0015}) {
    const Camera camera{60.0, 0.0, count, 0.0};
    const Table table = camera.record();
    const auto held = held_in(table);
    ASSERT_TRUE(held) << count;
    EXPECT_NEAR(1.0 / held->period, 60.0, 0.06);
    EXPECT_LT(worst_time(camera, table, *held), 2e-4);
  }
}

TEST(HeldSamples, CoarseCountersOfFreshRowsAreNotHeld) {
  for (const double count : {0.05, 0.02, 0.006, 0.003, 0.0015, 0.0004}) {
    for (const double noise : {0.0, 1e-3, 3e-3}) {
      EXPECT_FALSE(held_in(Camera{kRows, 0.0, count, noise}.record())) << count << " " << noise;
    }
  }
}

TEST(HeldSamples, FreshAndFewRowsAreNotHeld) {
  EXPECT_FALSE(held_in(Camera{kRows}.record()));
  EXPECT_FALSE(held_in(Camera{15.0}.record(1.0)));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
