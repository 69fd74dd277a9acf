// Whatever stops motors: that it does, holds, and says why.
#include <gtest/gtest.h>

#include "anthrob_driver/robot_driver.h"
#include "rig.h"

namespace anthrob {
namespace driver {
namespace {

using Phase = RobotDriver::Phase;

TEST(Stopping, AnEmergencyStopIsLatchedAndClearsWithoutMotion) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  rig.driver().emergency_stop();
  rig.run(2);
  EXPECT_EQ(rig.moving(), 0);
  EXPECT_FALSE(rig.driver().start_enable(rig.now()).accepted);
  rig.run(500);
  EXPECT_EQ(rig.moving(), 0);
  rig.driver().clear_faults(rig.now());
  EXPECT_TRUE(rig.driver().clearing(rig.now()));
  for (int ms = 0; rig.driver().clearing(rig.now()); ++ms) {
    rig.step();
    ASSERT_LT(ms, 50);
  }
  EXPECT_EQ(rig.samples.back().muscles[0].state, ecu::State::kIdle);
  rig.run(500);
  EXPECT_EQ(rig.moving(), 0);
  EXPECT_TRUE(rig.enable());
}

TEST(Stopping, AStopFromElsewhereIsCountedAndNamed) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  rig.driver().emergency_stop();
  rig.run(20);
  EXPECT_EQ(rig.driver().stops().count(), 0u);  // whoever called it here knows
  rig.driver().clear_faults(rig.now());
  rig.run(200);
  ASSERT_TRUE(rig.enable());
  rig.stranger.send(ecu::Frame{});
  rig.run(200);
  EXPECT_EQ(rig.driver().stops().count(), 1u);
  EXPECT_EQ(rig.driver().stops().last().value_or(""),
            "stop_latched: a STOP frame came from elsewhere on the bus; find who sent it; "
            "clear_faults, enable");
  rig.driver().clear_faults(rig.now());
  rig.run(200);
  // One that only the unit heard, while nothing ran.
  rig.rack.board(2).receive(ecu::Frame{});
  rig.run(200);
  EXPECT_EQ(rig.driver().stops().count(), 2u);
  EXPECT_EQ(rig.driver().stops().last().value_or("").substr(0, 20), "stop_latched: ecu_3:");
  EXPECT_TRUE(rig.driver().supervisor().stop_latched());
}

TEST(Stopping, WhereNobodyCouldStopItItStopsAndSaysWhy) {
  for (const Finding finding : {Finding::kUnregistered, Finding::kNoDescriptors}) {
    Rig rig;
    ASSERT_TRUE(rig.start());
    rig.driver().stop_unreachable(finding, "the detail", rig.now());
    rig.run(20);
    EXPECT_EQ(rig.moving(), 0);
    EXPECT_TRUE(rig.driver().supervisor().stop_latched());
    EXPECT_EQ(rig.driver().stops().count(), 1u);
    EXPECT_EQ(rig.driver().stops().last().value_or(""),
              std::string(info(finding).name) + ": " + info(finding).meaning + " (the detail); " +
                  info(finding).remedy);
    EXPECT_EQ(rig.driver().findings().count(finding), 1u);
    EXPECT_FALSE(rig.driver().start_enable(rig.now()).accepted);
    rig.driver().clear_faults(rig.now());
    rig.run(200);
    EXPECT_TRUE(rig.enable());
  }
}

TEST(Stopping, AStopThatAnEcuStillHoldsIsKnownAsItsOwn) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  rig.driver().emergency_stop();
  rig.run(50);
  rig.bus.tamper = [](const ecu::Frame& f, const MemoryBus::Port&) {
    const bool lost = ecu::function_of(f) == static_cast<int>(ecu::Function::kRequest);
    return lost ? std::vector<ecu::Frame>{} : std::vector<ecu::Frame>{f};
  };
  rig.driver().clear_faults(rig.now());
  rig.run(500);
  EXPECT_EQ(rig.driver().stops().last().value_or(""),
            "stop_latched: ecu_1: still holds an emergency stop of this driver; clear_faults, "
            "enable");
  rig.bus.tamper = nullptr;
  rig.driver().clear_faults(rig.now());
  rig.run(200);
  EXPECT_EQ(rig.driver().not_cleared(), std::nullopt);
  EXPECT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
}

TEST(Stopping, AStopTellsIfItMayNotHaveArrived) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  rig.host.set_up(false);
  rig.run(10);
  EXPECT_EQ(rig.driver().emergency_stop().reason,
            "the ECUs may not have received it: the CAN interface is down or missing. Without "
            "references they stop by themselves");
  rig.host.set_up(true);
  rig.run(10);
  EXPECT_EQ(rig.driver().disable().reason, "");
}

TEST(Stopping, IsAtOnceThoughTheNameOfTheFaultComesLate) {
  for (const bool named : {true, false}) {
    Rig rig;
    ASSERT_TRUE(rig.start());
    const int node = rig.hardware.ecus[2].node;
    const int heated = rig.ms;
    // STATE has the bus after everybody's measurements.
    rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
      const bool state =
          ecu::function_of(f) == static_cast<int>(ecu::Function::kState) && ecu::node_of(f) == node;
      return state && (!named || rig.ms < heated + 20) ? std::vector<ecu::Frame>{}
                                                       : std::vector<ecu::Frame>{f};
    };
    rig.rack.board(2).peripherals.temperature = 90;
    rig.run(15);
    EXPECT_EQ(rig.moving(), 0);
    EXPECT_EQ(rig.driver().phase(), Phase::kDisabled);
    EXPECT_EQ(rig.driver().stops().count(), 0u);
    rig.run(200);
    EXPECT_EQ(rig.driver().stops().count(), 1u);
    const std::string last = rig.driver().stops().last().value_or("");
    EXPECT_EQ(last.find("ecu_fault: ecu_3: an ECU reports a fault, named in its diagnostics"), 0u)
        << last;
    EXPECT_EQ(last.find("(over_temperature of infraspinatus)") != std::string::npos, named) << last;
    EXPECT_EQ(last.find("none"), std::string::npos) << last;
    const std::string outcome = rig.driver().last_outcome().reason;
    EXPECT_EQ(outcome.find("(over_temperature of ") != std::string::npos, named) << outcome;
  }
}

TEST(Stopping, WhatIsNotClearedIsNamed) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  const auto clear = [&] {
    rig.driver().clear_faults(rig.now());
    for (int ms = 0; rig.driver().clearing(rig.now()) && ms < 1000; ++ms) rig.step();
    return rig.driver().not_cleared().value_or("");
  };
  rig.rack.board(2).peripherals.supply = 8.0;
  rig.run(100);
  EXPECT_EQ(clear(), "ecu_3: fault supply_low persists");
  rig.rack.board(2).peripherals.supply = 12.0;
  EXPECT_EQ(clear(), "");
  rig.driver().emergency_stop();
  rig.run(10);
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    const bool lost = ecu::function_of(f) == static_cast<int>(ecu::Function::kRequest);
    return lost ? std::vector<ecu::Frame>{} : std::vector<ecu::Frame>{f};
  };
  EXPECT_EQ(clear(), "ecu_1: holds its emergency stop");
  rig.bus.tamper = nullptr;
  EXPECT_EQ(clear(), "");
  rig.rack.board(2).peripherals.supply = 8.0;
  rig.run(100);
  rig.rack.board(2).set_power(false);
  rig.run(100);
  EXPECT_EQ(clear(), "ecu_3: does not answer; check its power and cable");
}

TEST(Stopping, EveryDisableIsAHalt) {
  Rig rig;
  rig.run(1000);
  auto halted = [&, before = rig.driver().halts()]() mutable {
    return std::exchange(before, rig.driver().halts()) != before;
  };
  ASSERT_TRUE(rig.enable());
  EXPECT_FALSE(halted());
  rig.driver().disable();
  EXPECT_TRUE(halted());
  rig.driver().clear_faults(rig.now());
  ASSERT_TRUE(rig.enable());
  EXPECT_FALSE(halted());
  rig.driver().emergency_stop();
  EXPECT_TRUE(halted());
  rig.driver().clear_faults(rig.now());
  rig.run(200);
  EXPECT_FALSE(halted());
  rig.stranger.send(ecu::Frame{});
  rig.run(2);
  EXPECT_TRUE(halted());
  // Again, while that stop is latched: whoever sends it has not seen it clear.
  rig.run(200);
  EXPECT_FALSE(halted());
  rig.stranger.send(ecu::Frame{});
  rig.run(2);
  EXPECT_TRUE(halted());
}

/// As another driver on the bus does, which passes on every stop that it hears.
TEST(Stopping, TwoHostsDoNotPassAStopToAndFro) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  rig.driver().emergency_stop();
  int stops = 0;
  for (int ms = 0; ms < 1000; ++ms) {
    rig.step();
    BusEvent event;
    while (rig.stranger.receive(event)) {
      if (event.kind != BusEvent::Kind::kFrame || event.frame.id != 0) continue;
      ++stops;
      rig.stranger.send(ecu::Frame{});
    }
  }
  EXPECT_LE(stops, 202);  // one a cycle
  EXPECT_GE(stops, 200);
  rig.run(20);  // what is still under way
  rig.driver().clear_faults(rig.now());
  rig.run(200);
  EXPECT_TRUE(rig.enable());
}

TEST(Stopping, AStopWinsOverAnEnableUnderWay) {
  Rig rig;
  rig.run(1000);
  ASSERT_TRUE(rig.driver().start_enable(rig.now()).accepted);
  rig.run(1);
  rig.driver().emergency_stop();
  rig.commander_runs = true;
  rig.run(1000);
  EXPECT_EQ(rig.driver().phase(), Phase::kDisabled);
  EXPECT_EQ(rig.moving(), 0);
}

TEST(Stopping, AnEnableThatIsDisabledUnderWayDidNotSucceed) {
  Rig rig;
  rig.run(1000);
  ASSERT_TRUE(rig.driver().start_enable(rig.now()).accepted);
  rig.run(1);
  rig.driver().disable();
  rig.run(500);
  EXPECT_EQ(rig.driver().phase(), Phase::kDisabled);
  EXPECT_FALSE(rig.driver().last_outcome().accepted);
  EXPECT_EQ(rig.driver().last_outcome().reason, "disabled before every ECU confirmed");
  EXPECT_TRUE(rig.enable());
  EXPECT_TRUE(rig.driver().last_outcome().accepted);
}

TEST(Stopping, AnEcuThatRestartsWhileDisabledMustBeCleared) {
  Rig rig;
  // Switched on after the driver: that is no restart.
  rig.rack.board(5).set_power(false);
  rig.run(1000);
  rig.rack.board(5).set_power(true);
  rig.run(1000);
  ASSERT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
  rig.driver().disable();
  rig.run(100);
  rig.rack.board(5).set_power(false);
  rig.run(100);
  rig.rack.board(5).set_power(true);
  rig.run(1000);
  ASSERT_TRUE(rig.driver().link(5).configured());
  const auto outcome = rig.driver().start_enable(rig.now());
  EXPECT_FALSE(outcome.accepted);
  EXPECT_EQ(outcome.reason, "ecu_6: is in FAULT: call clear_faults first");
  rig.driver().clear_faults(rig.now());
  rig.run(100);
  EXPECT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
}

TEST(Stopping, AFaultIsTheUnitsInWhateverOrderTheFileNamesThem) {
  Hardware robot = load_hardware(ANTHROB_CONFIG_DIR "/anthrob/hardware.yaml", true);
  std::reverse(robot.ecus.begin(), robot.ecus.end());
  const int last = static_cast<int>(robot.ecus.size()) - 1;
  for (auto& muscle : robot.muscles) muscle.ecu = last - muscle.ecu;
  for (auto& joint : robot.joints) joint.ecu = last - *joint.ecu;
  for (auto& touch : robot.touch) touch.ecu = last - *touch.ecu;
  Rig rig(robot);
  ASSERT_TRUE(rig.start());
  rig.rack.board(1).set_power(false);
  rig.run(100);
  rig.rack.board(1).set_power(true);
  rig.run(1000);
  EXPECT_EQ(rig.driver().start_enable(rig.now()).reason,
            robot.ecus[1].name + ": is in FAULT: call clear_faults first");
  for (std::size_t m = 0; m < robot.muscles.size(); ++m) {
    EXPECT_EQ(rig.samples.back().muscles[m].state == ecu::State::kFault, robot.muscles[m].ecu == 1)
        << robot.muscles[m].name;
  }
}

TEST(Stopping, EmulatedEcusThatStartAnewWithAnotherSessionAreNoticed) {
  for (const bool other_session : {false, true}) {
    Rig rig;
    rig.run(1000);
    Rack anew(rig.hardware, rig.plant, rig.ecus, other_session);
    for (int i = 0; i < 1000; ++i, ++rig.ms) {
      if (rig.ms % rig.period_ms == 0) rig.driver().cycle(rig.now());
      rig.bus.deliver(rig.stamp());
      anew.receive();
      anew.tick();
      rig.bus.deliver(rig.stamp());
      rig.listen();
    }
    EXPECT_EQ(rig.driver().start_enable(rig.now()).accepted, !other_session);
    EXPECT_EQ(rig.driver().findings().count(Finding::kEcuRestarted), other_session ? 7u : 0u);
  }
}

TEST(Stopping, ALateHostIsNotTakenForADeadBus) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  rig.driver_runs = false;
  rig.run(60);
  rig.driver_runs = true;
  rig.run(100);
  EXPECT_GT(rig.driver().findings().count(Finding::kLateCycle), 0u);
  EXPECT_EQ(rig.driver().findings().count(Finding::kNoAcknowledge), 0u);
  EXPECT_EQ(rig.driver().bus_watch().trouble(), std::nullopt);
  EXPECT_EQ(rig.driver().phase(), Phase::kDisabled);  // the units stopped by themselves
  EXPECT_EQ(rig.driver().stops().last().value_or("").substr(0, 11), "ecu_stopped");
  EXPECT_EQ(rig.moving(), 0);
}

TEST(Stopping, ADeadBusIsNoticedBehindALateHost) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  rig.driver_runs = false;
  rig.host.jam(1000000);
  rig.run(60);
  rig.driver_runs = true;
  rig.run(60);
  EXPECT_GT(rig.driver().findings().count(Finding::kNoAcknowledge), 0u);
}

TEST(Stopping, AUnitOfAnotherVersionStopsTheMotors) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  ecu::StateReport report;
  report.version = ecu::kProtocolVersion + 1;
  rig.stranger.send(ecu::encode(report, rig.hardware.ecus[2].node));
  rig.run(20);
  EXPECT_EQ(rig.driver().phase(), Phase::kDisabled);
  EXPECT_EQ(rig.driver().stops().last().value_or("").substr(0, 13), "wrong_version");
  EXPECT_EQ(rig.moving(), 0);
}

TEST(StopLog, GivesAllSinceTheLastLook) {
  StopLog log;
  EXPECT_EQ(log.last(), std::nullopt);
  EXPECT_TRUE(log.since(0).empty());
  log.add("a");
  log.add("b");
  EXPECT_EQ(log.since(0), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(log.since(1), std::vector<std::string>{"b"});
  EXPECT_TRUE(log.since(2).empty());
  for (int i = 0; i < 20; ++i) log.add(std::to_string(i));
  EXPECT_EQ(log.count(), 22u);
  EXPECT_EQ(log.last(), "19");
  ASSERT_EQ(log.since(2).size(), StopLog::kRemembered);
  EXPECT_EQ(log.since(2).front(), "12");
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
