#include "control_mode.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

TEST(ControlMode, NamesAndUnitsOfTheContract) {
  EXPECT_EQ(name_of(ControlMode::kPosition), "POSITION");
  EXPECT_EQ(unit_of(ControlMode::kPosition), "rad");
  EXPECT_EQ(unit_of(ControlMode::kForce), "N");
  EXPECT_EQ(unit_of(ControlMode::kVoltage), "V");
  EXPECT_EQ(unit_of_message_mode(2), "A");
  EXPECT_EQ(unit_of_message_mode(9), "?");
}

}  // namespace
}  // namespace anthrob
