#include "reference_limits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slider_scale.h"

namespace anthrob {
namespace {

TEST(ReferenceLimits, ByMode) {
  ReferenceLimits limits;
  EXPECT_EQ(limits.of(ControlMode::kPosition).low, -10.0);
  EXPECT_EQ(limits.of(ControlMode::kForce).low, 0.0);
  EXPECT_EQ(limits.of(ControlMode::kVoltage).high, 12.0);
  limits.set(ControlMode::kForce, 200.0);
  limits.set(ControlMode::kPosition, 3.0);
  EXPECT_EQ(limits.of(ControlMode::kForce).low, 0.0);
  EXPECT_EQ(limits.of(ControlMode::kForce).high, 200.0);
  EXPECT_EQ(limits.of(ControlMode::kPosition).low, -3.0);
  EXPECT_EQ(limit_key(ControlMode::kForce), "force");
}

TEST(ReferenceLimits, WhatCannotBeALimitChangesNothing) {
  ReferenceLimits limits;
  for (const double wrong : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    limits.set(ControlMode::kVoltage, wrong);
    EXPECT_EQ(limits.of(ControlMode::kVoltage).high, 12.0);
  }
}

TEST(SliderScale, GoesThereAndBack) {
  const SliderScale scale({-10.0, 10.0});
  EXPECT_EQ(scale.step(-10.0), 0);
  EXPECT_EQ(scale.step(10.0), SliderScale::kSteps);
  EXPECT_EQ(scale.step(99.0), SliderScale::kSteps);
  for (int step = 0; step <= SliderScale::kSteps; ++step) {
    EXPECT_EQ(scale.step(scale.value(step)), step);
  }
}

}  // namespace
}  // namespace anthrob
