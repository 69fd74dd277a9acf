// Columns that are multiples of what they must be.
#include "measurement/column_factor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/random.h"

namespace anthrob {
namespace discovery {
namespace {

struct FactorColumns {
  std::vector<double> expected, recorded;

  std::optional<ColumnFactor> factor(double near) const {
    return column_factor(expected, recorded, {1000.0, 57.3, 9.55, 0.001}, near, ColumnOptions{});
  }
};

/// What a model expects, and `slope` times it with other motions beside, as a missing effect leaves
/// them: half of the squares of both are their own.
FactorColumns half_alike(double slope) {
  FactorColumns columns;
  for (int i = 0; i < 2000; ++i) {
    const double t = 0.01 * i, both = std::sin(2.0 * t);
    columns.expected.push_back(both);
    columns.recorded.push_back(slope * (both + std::sin(3.1 * t + 1.0)));
  }
  return columns;
}

TEST(ColumnFactor, WhatAModelLacksDoesNotHideALargeOne) {
  const double near = ColumnOptions{}.near;
  for (const double sign : {1.0, -1.0}) {
    const auto found = half_alike(sign * 400.0).factor(near);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->factor, sign * 1000.0);
    EXPECT_NEAR(found->measured, sign * 400.0, 50.0);
  }
  EXPECT_EQ(half_alike(0.003).factor(near)->factor, 0.001);
  // Neither makes it another sign.
  EXPECT_EQ(half_alike(-0.6).factor(near)->factor, -1.0);
  // Physics may make this, and this is neither.
  EXPECT_FALSE(half_alike(0.4).factor(near));
  EXPECT_FALSE(half_alike(5.0).factor(near));
}

TEST(ColumnFactor, WhereNothingIsBetweenTheColumnsItIsExact) {
  EXPECT_FALSE(half_alike(400.0).factor(ColumnOptions{}.exactly));
  EXPECT_FALSE(half_alike(-1.0).factor(ColumnOptions{}.exactly));
}

TEST(ColumnFactor, AJointAtRestHasNone) {
  const CounterRandom random(7, 1);
  FactorColumns columns;
  for (int i = 0; i < 2000; ++i) {
    const auto index = 2 * static_cast<std::uint64_t>(i);
    columns.expected.push_back(1e-4 * random.normal(index));
    columns.recorded.push_back(0.1 * random.normal(index + 1));
  }
  EXPECT_FALSE(columns.factor(ColumnOptions{}.near));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
