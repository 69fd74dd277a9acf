#include "dead_man.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

TEST(DeadMan, SaysWhyNothingMayBeSent) {
  DeadMan dead_man;
  EXPECT_EQ(dead_man.obstacle(0.0).value(), "the panel was hidden");
  dead_man.show(true);
  EXPECT_EQ(dead_man.obstacle(0.0).value(), "no robot publishes its states");
  dead_man.hear(1.0);
  EXPECT_FALSE(dead_man.obstacle(1.5).has_value());
  EXPECT_EQ(dead_man.obstacle(1.51).value(), "the robot's states are older than 0.5 s");
  dead_man.hear(1.6);
  dead_man.show(false);
  EXPECT_TRUE(dead_man.obstacle(1.6).has_value());
}

TEST(DeadMan, ACommandOutlivesNeitherAHungPanelNorASilentRobot) {
  DeadMan dead_man;
  dead_man.show(true);
  dead_man.hear(1.0);
  EXPECT_DOUBLE_EQ(dead_man.deadline(1.1), 1.4);
  EXPECT_DOUBLE_EQ(dead_man.deadline(1.4), 1.5);
}

}  // namespace
}  // namespace anthrob
