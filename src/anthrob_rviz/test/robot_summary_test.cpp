#include "robot_summary.h"

#include <gtest/gtest.h>

#include "readings.h"
#include "robot_connection.h"

namespace anthrob {
namespace {

TEST(RobotSummary, CountsStates) {
  const RobotSummary summary = summary_of({reading("a", 0.0), reading("b", 0.0, EcuState::kFault),
                                           reading("c", 0.0, EcuState::kStopping)});
  EXPECT_EQ(state_line("/anthrob", Presence::kHeard, summary),
            "/anthrob: 3 muscles, 1 enabled, 1 faulty");
  EXPECT_EQ(state_line("/anthrob", Presence::kSilent, summary),
            "/anthrob is silent; at last 3 muscles, 1 enabled, 1 faulty");
  EXPECT_EQ(state_line("/anthrob", Presence::kAbsent, {}),
            "no robot at /anthrob: nothing is commanded");
}

TEST(RobotNamespace, FromTheRoot) {
  EXPECT_EQ(robot_namespace("anthrob").value(), "/anthrob");
  EXPECT_EQ(robot_namespace(" /lab/arm_2/ ").value(), "/lab/arm_2");
  for (const char* wrong : {"", "/", "two words", "2nd", "a//b", "~a"}) {
    EXPECT_FALSE(robot_namespace(wrong).has_value()) << wrong;
  }
}

}  // namespace
}  // namespace anthrob
