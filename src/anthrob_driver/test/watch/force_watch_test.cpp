#include "watch/force_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

#include "watch/period.h"

namespace anthrob {
namespace driver {
namespace {

constexpr Winch kWinch{0.0115 * 128.0, 1.05e-6 * 128.0 * 128.0, 0.0065};  // Anthrob's type_1

struct Pull {
  double speed, force;  ///< [rad/s], [N]
};

/// A winch of which `efficiency` reaches the tendon, with a drag of `drag` [Nm]; its sensor reads
/// by `reads`. What the watch says within 3 s; `when` it did.
std::optional<std::string> watch(
    const std::function<Pull(double)>& course,
    const std::function<double(double)>& reads = [](double force) { return force; },
    double efficiency = 1.0, double drag = 0.0, double* when = nullptr) {
  ForceWatch watch(kWinch);
  double position = 0.0;
  for (double t = 0.0; t < 3.0; t += kPeriod) {
    const Pull m = course(t);
    position += kPeriod * m.speed;
    const double acceleration = (course(t + 1e-4).speed - course(t - 1e-4).speed) / 2e-4;
    const double torque =
        kWinch.radius * m.force / efficiency + kWinch.inertia * acceleration + drag;
    const auto wrong = watch.step(position, m.speed, torque / kWinch.back_emf, reads(m.force), t);
    if (!wrong) continue;
    if (when != nullptr) *when = t;
    return wrong;
  }
  return std::nullopt;
}

/// Pulls harder and harder.
Pull rises(double t) {
  return {0.2, 30.0 + 200.0 * t};
}

TEST(ForceWatch, ASensorThatStandsStillIsFoundBeforeTheTendonBreaks) {
  const auto stuck = [](double) { return 30.0; };
  double when = 0.0;
  EXPECT_NE(watch(rises, stuck, 1.0, 0.0, &when), std::nullopt);
  // 4 x 30 N + 100 N, in the mean of up to two intervals.
  EXPECT_GT(rises(when).force, 220.0);
  EXPECT_LT(rises(when).force, 220.0 + 2.0 * 200.0 * ForceWatch::kLasts);
  const auto half_a_kilonewton = [](double) { return Pull{0.5, 500.0}; };
  EXPECT_EQ(watch(half_a_kilonewton, stuck),
            "at 2.21 A its motor pulls with up to 500 N, and reads 30.0 N");
}

TEST(ForceWatch, ASpindleThatStandsIsLeftToItsUnit) {
  const auto jammed = [](double) { return Pull{0.0, 150.0}; };
  EXPECT_EQ(watch(jammed, [](double) { return 2.0; }), std::nullopt);
}

TEST(ForceWatch, ATendonThatIsReadIsNone) {
  EXPECT_EQ(watch(rises), std::nullopt);
  // A gear of 0.6, friction along the tendon that takes half, and a drag without load.
  EXPECT_EQ(watch(
                rises, [](double force) { return 0.5 * force; }, 0.6, 0.5),
            std::nullopt);
  // Accelerates from rest to no-load speed within 50 ms, without a tendon.
  EXPECT_EQ(watch([](double t) { return Pull{8.0 * std::tanh(t / 0.025), 0.0}; }), std::nullopt);
  // A load that comes suddenly, read 0.03 s late.
  double late[7] = {};
  int k = 0;
  const auto delayed = [&](double force) {
    const double old = late[k % 7];
    late[k++ % 7] = force;
    return old;
  };
  EXPECT_EQ(watch(
                [](double t) {
                  return Pull{0.5, t < 0.55 ? 0.0 : 180.0};
                },
                delayed),
            std::nullopt);
}

TEST(ForceWatch, WhatIsNotKnownIsNotWatched) {
  ForceWatch unknown(Winch{});
  ForceWatch known(kWinch);
  for (double t = 0.0; t < 1.0; t += kPeriod) {
    EXPECT_EQ(unknown.step(t, 1.0, 10.0, 5.0, t), std::nullopt);
    EXPECT_EQ(known.step(t, 1.0, 10.0, std::nan(""), t), std::nullopt);
  }
}

TEST(ForceWatch, AGapInTheMeasurementsBeginsAnew) {
  ForceWatch watch(kWinch);
  for (double t = 0.0; t < 0.095; t += kPeriod)
    EXPECT_EQ(watch.step(t, 1.0, 5.0, 5.0, t), std::nullopt);
  EXPECT_EQ(watch.step(0.2, 1.0, 5.0, 5.0, 0.2), std::nullopt);
  watch.restart();
  EXPECT_EQ(watch.step(0.31, 1.0, 5.0, 5.0, 0.31), std::nullopt);
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
