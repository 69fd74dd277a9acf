// How far fits are taken.
#include "fit/convergence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dry_elbow.h"

namespace anthrob {
namespace discovery {
namespace {

/// A valley whose ground, at 2 Nm, is left so high, and a narrow one at 2.5 Nm where nothing is
/// left.
DryElbow two_valleys(double left) {
  return DryElbow([left](double dry) {
    const double narrow = std::abs(dry - 2.5) / 0.12;
    const double wide = left + std::min(30.0, 100.0 * (dry - 2.0) * (dry - 2.0));
    return wide * std::min(1.0, narrow);
  });
}

TEST(Convergence, ALargeEffectIsTriedInOtherSizes) {
  const DryElbow robot = two_valleys(30.0);
  const Fitted fitted = robot.with(1.9), end = robot.convergence.to_the_end(fitted);
  EXPECT_NEAR(DryElbow::torque(robot.convergence.converged(fitted.variant, fitted.unknowns)), 2.0,
              0.05);
  EXPECT_NEAR(DryElbow::torque(end), 2.5, 0.01);
}

TEST(Convergence, OtherSizesAreNotTriedWhereNothingClearIsMissed) {
  const DryElbow robot = two_valleys(1.0);
  EXPECT_NEAR(DryElbow::torque(robot.convergence.to_the_end(robot.with(1.9))), 2.0, 0.1);
}

TEST(Convergence, RoundsEndWhereTheyCannotReachARival) {
  const DryElbow robot = two_valleys(1.0);
  const Fitted fitted = robot.with(1.5);
  const auto simulations = [&](double rival, Fitted& end) {
    const auto before = robot.evaluator.simulated();
    end = *robot.convergence.to_the_end_within_reach(fitted, HUGE_VAL, rival);
    return robot.evaluator.simulated() - before;
  };
  Fitted alone, near, far;
  const auto usual = simulations(HUGE_VAL, alone);
  EXPECT_EQ(simulations(alone.cost, near), usual);
  EXPECT_EQ(near.cost, alone.cost);
  EXPECT_EQ(DryElbow::torque(near), DryElbow::torque(alone));
  EXPECT_LT(simulations(0.5 * alone.cost, far), usual);
  EXPECT_LT(far.cost, fitted.cost);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
