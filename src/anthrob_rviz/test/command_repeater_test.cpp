#include "command_repeater.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

/// How often a command is due within two seconds, if somebody looks every so often.
int commands_in_two_seconds(double look_period) {
  CommandRepeater repeater;
  repeater.show(true);
  int count = 0;
  for (int i = 0; i * look_period < 2.0; ++i) {
    const double now = i * look_period;
    repeater.hear(now);
    count += repeater.due(now) ? 1 : 0;
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
  repeater.show(true);
  repeater.hear(0.0);
  EXPECT_TRUE(repeater.due(0.0));
  repeater.hear(3.0);
  EXPECT_TRUE(repeater.due(3.0));
  EXPECT_FALSE(repeater.due(3.01));
}

TEST(CommandRepeater, SaysWhyNothingMayBeSent) {
  CommandRepeater repeater;
  EXPECT_EQ(repeater.obstacle(0.0).value(), "the panel was hidden");
  repeater.show(true);
  EXPECT_EQ(repeater.obstacle(0.0).value(), "no robot publishes its states");
  EXPECT_FALSE(repeater.due(0.0));
  repeater.hear(1.0);
  EXPECT_FALSE(repeater.obstacle(1.5).has_value());
  EXPECT_EQ(repeater.obstacle(1.51).value(), "the robot's states are older than 0.5 s");
  EXPECT_FALSE(repeater.due(1.51));
  repeater.hear(1.6);
  repeater.show(false);
  EXPECT_FALSE(repeater.due(1.6));
}

}  // namespace
}  // namespace anthrob
