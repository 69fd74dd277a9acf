#include "anthrob_ecu/control_law.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace ecu {
namespace {

ControllerSettings settings() {
  ControllerSettings s;
  s.period = 0.001;
  s.voltage_limit = 12.0;
  s.position = {5.0, 0.5, 0.04};
  s.current = {0.2, 400.0};
  s.force = {0.5, 1.0, 0.5, 0.005};
  return s;
}

TEST(ControlLaw, VoltageIsPassedOnAndClipped) {
  ControllerMemory memory;
  EXPECT_DOUBLE_EQ(control(Mode::kVoltage, 3.5, {}, settings(), memory), 3.5);
  EXPECT_DOUBLE_EQ(control(Mode::kVoltage, 20.0, {}, settings(), memory), 12.0);
  EXPECT_DOUBLE_EQ(control(Mode::kVoltage, -20.0, {}, settings(), memory), -12.0);
}

TEST(ControlLaw, PositionIsProportionalDampedAndFedForward) {
  ControllerMemory memory;
  const Measurement measured{1.0, 2.0, 0.0, 30.0};
  EXPECT_DOUBLE_EQ(control(Mode::kPosition, 1.5, measured, settings(), memory),
                   5.0 * 0.5 - 0.5 * 2.0 + 0.04 * 30.0);
  EXPECT_DOUBLE_EQ(control(Mode::kPosition, 9.0, measured, settings(), memory), 12.0);
}

TEST(ControlLaw, CurrentReachesTheReferenceOnAResistiveLoad) {
  // Back EMF of 1 V, 0.79 ohm: the integral must find V = 1 + 0.79 * 2.
  ControllerMemory memory;
  Measurement measured;
  double voltage = 0.0;
  for (int i = 0; i < 200; ++i) {
    voltage = control(Mode::kCurrent, 2.0, measured, settings(), memory);
    measured.current = (voltage - 1.0) / 0.79;
  }
  EXPECT_NEAR(measured.current, 2.0, 1e-9);
  EXPECT_NEAR(voltage, 1.0 + 0.79 * 2.0, 1e-9);
}

TEST(ControlLaw, IntegralDoesNotWindUp) {
  ControllerMemory memory;
  Measurement measured;
  for (int i = 0; i < 10000; ++i) {
    EXPECT_DOUBLE_EQ(control(Mode::kForce, 100.0, measured, settings(), memory), 12.0);
  }
  // Overshoot: the output must leave the limit at once, not after thousands of ticks.
  measured.force = 150.0;
  EXPECT_LT(control(Mode::kForce, 100.0, measured, settings(), memory), 0.0);
}

TEST(ControlLaw, ChangingTheModeForgetsTheIntegral) {
  for (const Mode next : {Mode::kVoltage, Mode::kPosition, Mode::kForce}) {
    ControllerMemory memory, fresh;
    for (int i = 0; i < 10; ++i) control(Mode::kCurrent, 1.0, {}, settings(), memory);
    EXPECT_GT(memory.integral, 0.0);
    const double voltage = control(next, 1.0, {}, settings(), memory);
    EXPECT_EQ(voltage, control(next, 1.0, {}, settings(), fresh));
    EXPECT_EQ(memory.integral, fresh.integral);
  }
}

}  // namespace
}  // namespace ecu
}  // namespace anthrob
