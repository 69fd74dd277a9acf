#include "anthrob_ecu/supervisor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

namespace anthrob {
namespace ecu {
namespace {

std::vector<MuscleChannel> supervised() {
  MuscleChannel motor;
  motor.modes = {true, true, true, true};
  motor.lowest = {-12.0, -30.0, -8.0, 0.0};
  motor.highest = {12.0, 30.0, 8.0, 200.0};
  std::vector<MuscleChannel> list(4, motor);
  list[0].name = "a", list[0].ecu = "ecu_1";
  list[1].name = "b", list[1].ecu = "ecu_1";
  list[2].name = "c", list[2].ecu = "ecu_2";
  list[3].name = "ligament";
  list[3].takes_commands = false;
  return list;
}

struct Fixture {
  explicit Fixture(Supervisor::Options options = {}) : supervisor(supervised(), options) {}
  bool command(double time, double reference = 1.0) {
    return supervisor.command({"a"}, {1}, {reference}, time, accepted).accepted;
  }
  Supervisor supervisor;
  std::vector<MuscleReference> accepted;
};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Supervisor, NothingMovesBeforeEnable) {
  Fixture f;
  EXPECT_FALSE(f.command(0.0));
  EXPECT_FALSE(f.supervisor.follows_references(0));
  EXPECT_EQ(f.supervisor.state(0), State::kIdle);
  EXPECT_TRUE(f.supervisor.enable(0.1).accepted);
  EXPECT_TRUE(f.supervisor.follows_references(0));
}

TEST(Supervisor, AMuscleHasOneSenderUntilThatIsSilent) {
  Fixture f;
  f.supervisor.enable(0.0);
  const auto send = [&](const std::string& muscle, const std::string& sender, double time) {
    return f.supervisor.command({muscle}, {1}, {1.0}, time, f.accepted, sender);
  };
  EXPECT_TRUE(send("a", "/player", 0.0).accepted);
  const auto outcome = send("a", "/zero_gravity", 0.1);
  EXPECT_FALSE(outcome.accepted);
  EXPECT_EQ(outcome.reason,
            "muscle 'a' is commanded by /player; /zero_gravity may command it once that has been "
            "silent for 0.25 s");
  EXPECT_TRUE(f.accepted.empty());
  EXPECT_EQ(f.supervisor.rejected_count(), 1u);
  EXPECT_TRUE(send("b", "/zero_gravity", 0.1).accepted) << "another muscle";
  EXPECT_TRUE(send("a", "/player", 0.2).accepted);
  EXPECT_FALSE(send("a", "/zero_gravity", 0.44).accepted);
  EXPECT_TRUE(send("a", "/zero_gravity", 0.46).accepted) << "it was silent";
  EXPECT_FALSE(f.supervisor.update(0.46)) << "nothing stopped meanwhile";
  EXPECT_FALSE(send("a", "/player", 0.5).accepted) << "it has lost the muscle";
  EXPECT_TRUE(send("a", "", 0.5).accepted) << "an unknown sender, as of a program without ROS";
}

TEST(Supervisor, AStopEndsTheOwnershipAndSoDoesTimeThatIsSetBack) {
  Fixture f;
  f.supervisor.enable(0.0);
  const auto send = [&](const std::string& sender, double time) {
    return f.supervisor.command({"a"}, {1}, {1.0}, time, f.accepted, sender).accepted;
  };
  EXPECT_TRUE(send("/player", 5.0));
  f.supervisor.disable();
  f.supervisor.enable(5.0);
  EXPECT_TRUE(send("/hold", 5.1));
  f.supervisor.emergency_stop();
  f.supervisor.clear_faults();
  f.supervisor.enable(5.2);
  EXPECT_TRUE(send("/player", 5.2));
  EXPECT_TRUE(send("/hold", 1.0));
}

TEST(Supervisor, ARefusedCommandMakesNobodyTheSender) {
  Fixture f;
  f.supervisor.enable(0.0);
  EXPECT_FALSE(f.supervisor.command({"a"}, {1}, {kNan}, 0.0, f.accepted, "/player").accepted);
  EXPECT_TRUE(f.supervisor.command({"a"}, {1}, {1.0}, 0.1, f.accepted, "/hold").accepted);
}

TEST(Supervisor, RefusesMalformedCommandsWholeAndSaysWhy) {
  const struct {
    std::vector<std::string> names;
    std::vector<std::uint8_t> modes;
    std::vector<double> references;
    const char* reason;
  } cases[] = {
      {{}, {}, {}, "no muscle"},
      {{"a", "x"}, {0, 0}, {0, 0}, "'x': no such muscle; expected one of a, "},
      {{""}, {0}, {0}, "no such muscle"},
      {{"A"}, {0}, {0}, "no such muscle; did you mean 'a'?"},
      {{"a"}, {}, {1}, "1 names, 0 modes"},
      {{"a"}, {0}, {}, "0 references"},
      {{"a"}, {0, 0}, {1}, "2 modes"},
      {{"a", "b"}, {0, 0}, {1}, "1 references"},
      {{"a", "a"}, {0, 0}, {1, 1}, "named twice"},
      {{"a"}, {4}, {0}, "mode 4"},
      {{"a"}, {255}, {0}, "mode 255"},
      {{"a"}, {0}, {kNan}, "not a finite"},
      {{"a"}, {1}, {INFINITY}, "not a finite"},
      {{"a"}, {2}, {-INFINITY}, "not a finite"},
      {{"a"}, {0}, {12.5}, "VOLTAGE 12.5 V: expected -12 to 12"},
      {{"a"}, {1}, {-31}, "POSITION -31 rad"},
      {{"a"}, {2}, {9}, "CURRENT 9 A"},
      {{"a"}, {3}, {-1}, "FORCE -1 N: expected 0 to 200"},
      {{"a", "b"}, {0, 0}, {1, 1e9}, "'b'"},
      {{"ligament"}, {0}, {0}, "passive"},
  };
  Fixture f;
  f.supervisor.enable(0.0);
  std::size_t count = 0;
  for (const auto& test : cases) {
    const auto outcome =
        f.supervisor.command(test.names, test.modes, test.references, 0.0, f.accepted);
    EXPECT_FALSE(outcome.accepted);
    EXPECT_TRUE(f.accepted.empty());
    EXPECT_NE(outcome.reason.find(test.reason), std::string::npos) << outcome.reason;
    EXPECT_EQ(f.supervisor.rejected_count(), ++count);
  }
  EXPECT_FALSE(f.supervisor.command_age(1.0));  // none of them counts as a command
}

TEST(Supervisor, CommandsForWhatIsStoppedAreRefusedCountedAndNamed) {
  Fixture f;
  const auto expect_refused = [&](double time, const std::string& muscle, std::size_t count,
                                  const std::string& reason) {
    const std::optional<double> age = f.supervisor.command_age(10.0);
    const auto outcome = f.supervisor.command({"a", muscle}, {0, 0}, {1.0, 1.0}, time, f.accepted);
    EXPECT_FALSE(outcome.accepted) << reason;
    EXPECT_TRUE(f.accepted.empty());
    EXPECT_EQ(outcome.reason, reason);
    EXPECT_EQ(f.supervisor.last_rejection(), reason);
    EXPECT_EQ(f.supervisor.rejected_count(), count);
    EXPECT_EQ(f.supervisor.command_age(10.0), age);
  };
  expect_refused(0.0, "b", 1, "not enabled: call enable");
  f.supervisor.enable(0.0);
  f.command(1.0);
  f.supervisor.fault("ecu_2");
  expect_refused(1.1, "c", 2, "ecu_2 is in FAULT: call clear_faults, then enable");
  f.supervisor.emergency_stop();
  expect_refused(1.2, "b", 3, "emergency stop is latched: call clear_faults, then enable");
  f.supervisor.clear_faults();
  f.supervisor.refuse("home is running");
  EXPECT_EQ(f.supervisor.rejected_count(), 4u);
  EXPECT_EQ(f.supervisor.last_rejection(), "home is running");
}

TEST(Supervisor, AFaultBesideAnEnabledEcuIsCleared) {
  Fixture f;
  f.supervisor.enable(0.0);
  EXPECT_EQ(f.supervisor.clear_faults().reason, "nothing to clear");
  f.supervisor.fault("ecu_2");
  const Supervisor::Outcome outcome = f.supervisor.clear_faults();
  EXPECT_TRUE(outcome.accepted);
  EXPECT_EQ(outcome.reason, "");
  EXPECT_EQ(f.supervisor.state(0), State::kEnabled);
  EXPECT_EQ(f.supervisor.state(2), State::kIdle);
  EXPECT_TRUE(f.supervisor.enable(0.1).accepted);
  EXPECT_EQ(f.supervisor.state(2), State::kEnabled);
}

TEST(Supervisor, OnlyFreshValidCommandsFeedTheWatch) {
  Fixture f;
  f.supervisor.enable(0.0);
  EXPECT_FALSE(f.supervisor.update(100.0));  // the watch starts with the first command
  f.command(100.0);
  EXPECT_FALSE(f.supervisor.update(100.4));
  EXPECT_FALSE(f.command(100.45, kNan));
  EXPECT_TRUE(f.supervisor.update(100.51));
  EXPECT_EQ(f.supervisor.state(0), State::kStopping);
  EXPECT_EQ(f.supervisor.state(2), State::kStopping);
  EXPECT_FALSE(f.supervisor.update(100.6));  // reported once
}

TEST(Supervisor, AfterATimeoutHardwareStaysDisabledUntilEnabled) {
  Fixture f;
  f.supervisor.enable(0.0);
  f.command(0.0);
  f.supervisor.update(1.0);
  EXPECT_FALSE(f.command(1.1));
  EXPECT_FALSE(f.supervisor.follows_references(0));
  f.supervisor.enable(1.2);
  EXPECT_TRUE(f.supervisor.follows_references(0));
}

TEST(Supervisor, AutoEnableResumesAfterATimeoutButNotAfterAStop) {
  Fixture f({0.5, true});
  EXPECT_TRUE(f.supervisor.follows_references(0));
  f.command(0.0);
  f.supervisor.update(1.0);
  EXPECT_FALSE(f.supervisor.follows_references(0));
  f.command(1.1);
  EXPECT_TRUE(f.supervisor.follows_references(0));

  f.supervisor.emergency_stop();
  f.command(1.2);
  EXPECT_FALSE(f.supervisor.follows_references(0));
  EXPECT_FALSE(f.supervisor.enable(1.3).accepted);
  f.supervisor.clear_faults();
  EXPECT_EQ(f.supervisor.state(0), State::kIdle);
  f.command(1.4);
  EXPECT_FALSE(f.supervisor.follows_references(0));
  EXPECT_TRUE(f.supervisor.enable(1.5).accepted);
  EXPECT_TRUE(f.supervisor.follows_references(0));
}

TEST(Supervisor, AutoEnableDoesNotEndADeliberateDisable) {
  Fixture f({0.5, true});
  f.command(0.0);
  f.supervisor.disable();
  for (const double time : {0.1, 0.2, 0.3}) {
    f.command(time);
    f.supervisor.update(time);
    EXPECT_FALSE(f.supervisor.follows_references(0)) << time;
  }
  EXPECT_TRUE(f.supervisor.enable(0.4).accepted);
  f.command(0.4);
  EXPECT_TRUE(f.supervisor.follows_references(0));
}

TEST(Supervisor, AutoEnableDoesNotEndADisableAfterATimeout) {
  Fixture f({0.5, true});
  f.command(0.0);
  EXPECT_TRUE(f.supervisor.update(1.0));
  f.supervisor.disable();
  for (const double time : {1.1, 1.2}) {
    f.command(time);
    EXPECT_FALSE(f.supervisor.follows_references(0)) << time;
  }
}

TEST(Supervisor, EnablingWhatRunsDoesNotEndTheWatch) {
  Fixture f;
  EXPECT_EQ(f.supervisor.enable(0.0).reason, "");
  f.command(0.0);
  const auto outcome = f.supervisor.enable(0.3);
  EXPECT_TRUE(outcome.accepted);
  EXPECT_EQ(outcome.reason, "already enabled");
  EXPECT_FALSE(f.supervisor.update(0.5));
  EXPECT_TRUE(f.supervisor.update(0.6));
  EXPECT_EQ(f.supervisor.state(0), State::kStopping);
}

TEST(Supervisor, ZeroTimeoutNeverStops) {
  Fixture f({0.0, false});
  f.supervisor.enable(0.0);
  f.command(0.0);
  EXPECT_FALSE(f.supervisor.update(1e6));
}

TEST(Supervisor, TheWatchStartsAnewOnRequest) {
  Fixture f;
  f.supervisor.enable(0.0);
  f.command(0.0);
  f.supervisor.restart_watch(2.0);
  EXPECT_FALSE(f.supervisor.update(2.4));
  EXPECT_TRUE(f.supervisor.update(2.6));
}

TEST(Supervisor, SkippedTimeMakesNoCommandOld) {
  Fixture f;
  f.supervisor.enable(0.0);
  f.command(0.0);
  f.supervisor.skip(1.0);
  EXPECT_FALSE(f.supervisor.update(1.4));
  EXPECT_TRUE(f.supervisor.update(1.6));
}

TEST(Supervisor, SurvivesTimeJumpingBack) {
  Fixture f;
  f.supervisor.enable(100.0);
  f.command(100.0);
  EXPECT_FALSE(f.supervisor.update(3.0));
  EXPECT_FALSE(f.supervisor.update(3.4));
  EXPECT_TRUE(f.supervisor.update(3.6));
}

TEST(Supervisor, AFaultStopsItsEcuAndBlocksEnable) {
  Fixture f;
  f.supervisor.enable(0.0);
  EXPECT_TRUE(f.supervisor.fault("ecu_2").accepted);
  EXPECT_FALSE(f.supervisor.fault("ecu_9").accepted);
  EXPECT_EQ(f.supervisor.state(2), State::kFault);
  EXPECT_TRUE(f.supervisor.follows_references(0));
  const auto outcome = f.supervisor.enable(0.1);
  EXPECT_FALSE(outcome.accepted);
  EXPECT_NE(outcome.reason.find("ecu_2"), std::string::npos);
}

TEST(Supervisor, MusclesOfOneEcuShareItsState) {
  Fixture f;
  EXPECT_EQ(f.supervisor.ecus(), (std::vector<std::string>{"ecu_1", "ecu_2", "ligament"}));
}

}  // namespace
}  // namespace ecu
}  // namespace anthrob
