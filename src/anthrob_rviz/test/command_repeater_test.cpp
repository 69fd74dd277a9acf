#include "command_repeater.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

const std::vector<Reference> kCommand = {{"flexor", ControlMode::kForce, 5.0}};

/// How often a command is due within two seconds, if somebody looks every so often.
int commands_in_two_seconds(double look_period) {
  CommandRepeater repeater;
  repeater.set(kCommand, 2.0);
  int count = 0;
  for (int i = 0; i * look_period < 2.0; ++i) {
    count += repeater.take_due(i * look_period).empty() ? 0 : 1;
  }
  return count;
}

TEST(CommandRepeater, TwentyASecondHoweverOftenOneLooks) {
  EXPECT_NEAR(commands_in_two_seconds(0.001), 40, 1);
  EXPECT_NEAR(commands_in_two_seconds(0.010), 40, 1);
  EXPECT_NEAR(commands_in_two_seconds(0.013), 40, 1);
  EXPECT_NEAR(commands_in_two_seconds(0.033), 40, 1);
}

TEST(CommandRepeater, WhatWasMissedIsNotMadeUpFor) {
  CommandRepeater repeater;
  repeater.set(kCommand, 9.0);
  EXPECT_EQ(repeater.take_due(0.0).size(), 1U);
  EXPECT_EQ(repeater.take_due(3.0).size(), 1U);
  EXPECT_TRUE(repeater.take_due(3.01).empty());
}

TEST(CommandRepeater, EndsAtItsDeadlineAndWithoutReferences) {
  CommandRepeater repeater;
  EXPECT_TRUE(repeater.take_due(0.0).empty());
  repeater.set(kCommand, 1.0);
  EXPECT_FALSE(repeater.take_due(1.0).empty());
  EXPECT_TRUE(repeater.take_due(1.1).empty());
  repeater.set(kCommand, 3.0);
  repeater.set({}, 3.0);
  EXPECT_TRUE(repeater.take_due(2.0).empty());
}

}  // namespace
}  // namespace anthrob
