// Intervals of what no longer changes anything at the fit.
#include "fit/flat_range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dry_elbow.h"

namespace anthrob {
namespace discovery {
namespace {

TEST(FlatRange, FrictionThatHoldsAJointInAnyCaseIsKnownFromBelow) {
  // The cost rises by 1.92 nat where half of 100 squares is that much more, on average of the
  // noise.
  const DryElbow robot([](double dry) { return 10.0 * std::max(0.0, 0.5 - dry); });
  const Fitted held = robot.with(1.0);
  ASSERT_TRUE(is_flat(held, 0, {}));
  const auto [low, high] = flat_range(robot.train, held, 0);
  EXPECT_EQ(high, 10.0);
  EXPECT_LT(low, 0.5);
  const auto rise = [&](double torque) { return robot.with(torque).cost - held.cost; };
  EXPECT_GE(rise(low), 1.92);
  EXPECT_LT(rise(low + 0.01), 1.92);
}

TEST(FlatRange, ExpectationsDetermineNothing) {
  const DryElbow robot([](double) { return 0.0; });
  Fitted held = robot.with(1.0);
  held.unknowns[0].expected = 1.0;
  held.unknowns[0].spread = 0.1;
  const auto [low, high] = flat_range(robot.train, held, 0);
  EXPECT_EQ(low, 0.0);
  EXPECT_EQ(high, 10.0);
}

TEST(FlatRange, WhatChangesSomethingIsNotFlat) {
  const DryElbow robot([](double dry) { return 10.0 * (dry - 0.5); });
  EXPECT_FALSE(is_flat(robot.with(0.5), 0, {}));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
