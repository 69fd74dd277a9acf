#include "anthrob_ecu/state_machine.h"

#include <gtest/gtest.h>

#include <vector>

namespace anthrob {
namespace ecu {
namespace {

constexpr Event kAllEvents[] = {
    Event::kSelfTestPassed, Event::kEnable,        Event::kDisable, Event::kEmergencyStop,
    Event::kCommandTimeout, Event::kFaultDetected, Event::kClear};

StateMachine idle() {
  StateMachine machine;
  machine.handle(Event::kSelfTestPassed);
  return machine;
}

TEST(StateMachine, StartsWithOutputsOff) {
  StateMachine machine;
  EXPECT_EQ(machine.state(), State::kBoot);
  EXPECT_FALSE(machine.handle(Event::kEnable));
  EXPECT_FALSE(machine.follows_references());
}

TEST(StateMachine, OnlyEnableLeadsToMotion) {
  // Any sequence of up to five events: references are followed only if the last state-changing
  // event that concerns enabling was an accepted enable.
  std::vector<std::pair<StateMachine, bool>> frontier{{StateMachine(), false}};
  for (int depth = 0; depth < 5; ++depth) {
    std::vector<std::pair<StateMachine, bool>> next;
    for (const auto& [machine, enabled] : frontier) {
      for (Event event : kAllEvents) {
        StateMachine copy = machine;
        const bool accepted = copy.handle(event);
        bool expected = enabled;
        if (accepted && event == Event::kEnable) expected = true;
        if (accepted && event != Event::kEnable) expected = false;
        EXPECT_EQ(copy.follows_references(), expected);
        next.emplace_back(copy, expected);
      }
    }
    frontier = next;
  }
}

TEST(StateMachine, EmergencyStopHoldsUntilCleared) {
  StateMachine machine = idle();
  EXPECT_TRUE(machine.handle(Event::kEnable));
  EXPECT_TRUE(machine.handle(Event::kEmergencyStop));
  EXPECT_EQ(machine.state(), State::kStopping);
  EXPECT_FALSE(machine.handle(Event::kEnable));
  EXPECT_FALSE(machine.follows_references());
  EXPECT_TRUE(machine.handle(Event::kClear));
  EXPECT_EQ(machine.state(), State::kIdle);
  EXPECT_FALSE(machine.follows_references());
  EXPECT_TRUE(machine.handle(Event::kEnable));
  EXPECT_TRUE(machine.follows_references());
}

TEST(StateMachine, EmergencyStopIsAcceptedInEveryState) {
  for (const std::vector<Event>& way :
       std::vector<std::vector<Event>>{{},
                                       {Event::kSelfTestPassed},
                                       {Event::kSelfTestPassed, Event::kEnable},
                                       {Event::kSelfTestPassed, Event::kEnable, Event::kDisable},
                                       {Event::kFaultDetected}}) {
    StateMachine machine;
    for (Event event : way) machine.handle(event);
    EXPECT_TRUE(machine.handle(Event::kEmergencyStop));
    EXPECT_TRUE(machine.stop_latched());
    EXPECT_FALSE(machine.follows_references());
  }
}

TEST(StateMachine, AStopWhileBootingIsLatchedAndLeavesTheSelfTestToCome) {
  StateMachine machine;
  EXPECT_TRUE(machine.handle(Event::kEmergencyStop));
  EXPECT_EQ(machine.state(), State::kBoot);
  EXPECT_FALSE(machine.handle(Event::kClear));
  EXPECT_TRUE(machine.handle(Event::kSelfTestPassed));
  EXPECT_EQ(machine.state(), State::kStopping);
  EXPECT_FALSE(machine.handle(Event::kEnable));
}

TEST(StateMachine, TimeoutStopsAndEnableResumes) {
  StateMachine machine = idle();
  EXPECT_FALSE(machine.handle(Event::kCommandTimeout));
  machine.handle(Event::kEnable);
  EXPECT_TRUE(machine.handle(Event::kCommandTimeout));
  EXPECT_EQ(machine.state(), State::kStopping);
  EXPECT_TRUE(machine.handle(Event::kEnable));
}

TEST(StateMachine, FaultNeedsClear) {
  StateMachine machine = idle();
  machine.handle(Event::kEnable);
  machine.handle(Event::kFaultDetected);
  EXPECT_EQ(machine.state(), State::kFault);
  EXPECT_FALSE(machine.handle(Event::kEnable));
  EXPECT_TRUE(machine.handle(Event::kClear));
  EXPECT_EQ(machine.state(), State::kIdle);
}

}  // namespace
}  // namespace ecu
}  // namespace anthrob
