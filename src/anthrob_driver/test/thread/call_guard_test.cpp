#include "thread/call_guard.h"

#include <gtest/gtest.h>

#include <functional>

#include "rig.h"

namespace anthrob {
namespace driver {
namespace {

const char* const kRefused = "the motors were stopped after this was called; call it again";

class CallGuardTest : public testing::Test {
 protected:
  void SetUp() override { rig.run(1000); }
  CallGuard call() { return CallGuard(rig.driver().halts()); }

  Rig rig;
  RobotDriver::Outcome outcome{true, ""};
};

TEST_F(CallGuardTest, WithoutAStopItBegins) {
  const CallGuard enable = call();
  EXPECT_TRUE(enable.may_begin(rig.driver(), outcome));
  ASSERT_TRUE(rig.enable());
  outcome = rig.driver().last_outcome();
  enable.confirm(rig.driver(), outcome);
  EXPECT_TRUE(outcome.accepted) << outcome.reason;
}

TEST_F(CallGuardTest, WhateverStopsTheMotorsMeanwhileWinsOverIt) {
  const std::function<void()> stops[] = {
      [this] { rig.driver().disable(); },
      [this] { rig.driver().emergency_stop(); },
      // Latched already: a STOP frame says it again.
      [this] {
        rig.stranger.send(ecu::Frame{});
        rig.run(2);
      },
  };
  for (const auto& stop : stops) {
    const CallGuard clear = call();
    stop();
    outcome = {true, ""};
    EXPECT_FALSE(clear.may_begin(rig.driver(), outcome));
    EXPECT_FALSE(outcome.accepted);
    EXPECT_EQ(outcome.reason, kRefused);
    // What is called now may begin.
    EXPECT_TRUE(call().may_begin(rig.driver(), outcome));
  }
}

TEST_F(CallGuardTest, ASuccessThatWasUndoneIsNone) {
  const CallGuard enable = call();
  ASSERT_TRUE(rig.enable());
  outcome = rig.driver().last_outcome();
  ASSERT_TRUE(outcome.accepted);
  rig.driver().emergency_stop();
  enable.confirm(rig.driver(), outcome);
  EXPECT_FALSE(outcome.accepted);
  EXPECT_EQ(outcome.reason, "it succeeded, and then the motors were stopped");
}

TEST_F(CallGuardTest, ARefusalKeepsItsReason) {
  const CallGuard enable = call();
  rig.driver().disable();
  outcome = {false, "ecu_3: does not answer"};
  enable.confirm(rig.driver(), outcome);
  EXPECT_EQ(outcome.reason, "ecu_3: does not answer");
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
