#include "routine/home.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rig.h"

namespace anthrob {
namespace driver {
namespace {

/// Whether a frame writes the present position at this node.
bool zero_of(const ecu::Frame& f, int node) {
  return ecu::function_of(f) == static_cast<int>(ecu::Function::kParameterRequest) &&
         ecu::node_of(f) == node && ecu::decode_parameter(f).index == ecu::kPresentPosition;
}

/// An enabled robot whose tendons get tight a little after the start.
class HomeTest : public testing::Test {
 protected:
  void SetUp() override {
    for (std::size_t m = 0; m < rig.hardware.muscles.size(); ++m) rig.plant.slacken(m, 1.0);
    rig.run(1000);
    ASSERT_TRUE(rig.enable());
  }
  void home() {
    ASSERT_TRUE(rig.driver().start_home(rig.now()).accepted);
    for (int ms = 0; ms < 30000 && rig.driver().home().running(); ++ms) {
      rig.step();
      for (std::size_t m = 0; m < 11; ++m) {
        highest = std::max(highest, rig.plant.muscle(m).force);
      }
      if (ms == 8000 && sabotage) sabotage();
    }
  }
  std::string failure() { return rig.driver().home().failure().value_or(""); }
  /// Enabled again after a brown-out of one unit.
  void restart(std::size_t ecu) {
    rig.rack.board(ecu).set_power(false);
    rig.rack.board(ecu).set_power(true);
    rig.run(2000);
    ASSERT_EQ(rig.driver().phase(), RobotDriver::Phase::kDisabled);
    rig.driver().clear_faults(rig.now());
    rig.run(100);
    ASSERT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
  }
  RobotDriver::Outcome command(const std::string& muscle, ecu::Mode mode, double reference) {
    return rig.driver().command({muscle}, {static_cast<std::uint8_t>(mode)}, {reference},
                                rig.now());
  }

  Rig rig;
  double highest = 0.0;
  std::function<void()> sabotage;
};

TEST_F(HomeTest, AnAnswerToSomethingElseIsNoZero) {
  rig.bus.tamper = [](const ecu::Frame& f, const MemoryBus::Port&) {
    if (ecu::function_of(f) != static_cast<int>(ecu::Function::kParameterReply)) {
      return std::vector<ecu::Frame>{f};
    }
    ecu::ParameterMessage reply = ecu::decode_parameter(f);
    reply.index = 3;
    return std::vector<ecu::Frame>{ecu::encode_parameter_reply(reply, ecu::node_of(f))};
  };
  home();
  EXPECT_NE(failure(), "");
  EXPECT_EQ(rig.driver().findings().count(Finding::kConfigurationRefused), 0u);
}

TEST_F(HomeTest, TensionsAllAndSetsZero) {
  int zeros_of_hand = 0;
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    zeros_of_hand += zero_of(f, rig.hardware.ecus[6].node);
    return std::vector<ecu::Frame>{f};
  };
  home();
  EXPECT_EQ(failure(), "");
  rig.run(50);
  for (std::size_t m = 0; m < 11; ++m) {
    EXPECT_NEAR(rig.plant.muscle(m).force, 5.0, 1.1);
    EXPECT_GT(rig.plant.muscle(m).position, 1.0);
    EXPECT_NEAR(rig.samples.back().muscles[m].position, 0.0, 0.05);
  }
  EXPECT_LT(highest, 20.0);
  // The hand has no force sensors and stays as it is.
  EXPECT_EQ(rig.plant.voltage(12), 0.0);
  EXPECT_EQ(zeros_of_hand, 0);
}

TEST_F(HomeTest, SendsAZeroAgainThatWasLost) {
  int drop = 3;
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    const bool lost = zero_of(f, rig.hardware.ecus[2].node) && drop-- > 0;
    return lost ? std::vector<ecu::Frame>{} : std::vector<ecu::Frame>{f};
  };
  home();
  EXPECT_LE(drop, 0);
  EXPECT_EQ(failure(), "");
  rig.run(50);
  for (std::size_t m = 0; m < 11; ++m) {
    EXPECT_NEAR(rig.samples.back().muscles[m].position, 0.0, 0.05);
  }
}

TEST_F(HomeTest, NamesAMuscleWhoseZeroIsNotTaken) {
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    return zero_of(f, rig.hardware.ecus[2].node) ? std::vector<ecu::Frame>{}
                                                 : std::vector<ecu::Frame>{f};
  };
  home();
  const auto muscle = static_cast<std::size_t>(rig.hardware.ecus[2].muscles[0]);
  EXPECT_EQ(failure(), rig.hardware.muscles[muscle].name + ": ecu_3 does not confirm the new zero");
  rig.run(20);
  EXPECT_EQ(rig.moving(), 0);
  EXPECT_EQ(rig.driver().phase(), RobotDriver::Phase::kDisabled);
}

TEST_F(HomeTest, NamesAMuscleWhoseEcuRefusesTheZero) {
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    if (!zero_of(f, rig.hardware.ecus[2].node)) return std::vector<ecu::Frame>{f};
    ecu::ParameterMessage message = ecu::decode_parameter(f);
    message.value = 1e3f;
    return std::vector<ecu::Frame>{
        ecu::encode_parameter_request(message, rig.hardware.ecus[2].node)};
  };
  home();
  EXPECT_NE(failure().find("ecu_3 does not confirm the new zero"), std::string::npos) << failure();
}

TEST_F(HomeTest, NamesABrokenTendonAndStops) {
  rig.plant.cut(3);
  home();
  EXPECT_NE(failure().find("supraspinatus"), std::string::npos) << failure();
  EXPECT_NE(failure().find("broken"), std::string::npos) << failure();
  EXPECT_EQ(rig.driver().stops().count(), 1u);
  EXPECT_EQ(rig.driver().stops().last().value_or(""),
            "home_failed: " + failure() + "; " + info(Finding::kHomeFailed).remedy);
  rig.run(20);
  EXPECT_EQ(rig.moving(), 0);
  EXPECT_EQ(rig.driver().phase(), RobotDriver::Phase::kDisabled);
}

TEST_F(HomeTest, NamesATendonThatSlips) {
  for (std::size_t m = 0; m < 11; ++m) rig.plant.slacken(m, 0.3);
  rig.plant.slacken(9, 3.0);  // keeps the others waiting
  sabotage = [this] { rig.plant.slacken(7, 9.0); };
  const_cast<HomeRoutine&>(rig.driver().hardware().home).settle_time = 15.0;
  home();
  EXPECT_NE(failure().find("pectoralis_major"), std::string::npos) << failure();
  EXPECT_NE(failure().find("slips"), std::string::npos) << failure();
}

TEST_F(HomeTest, NamesAMotorThatWindsTheWrongWay) {
  Home home(rig.hardware);
  std::vector<Home::Reading> readings(rig.hardware.muscles.size(), {0.3, 0.0});
  home.start(0.0);
  home.step(readings, 0.0);
  readings[3].position = -0.19;
  home.step(readings, 0.005);
  EXPECT_TRUE(home.running());
  readings[3].position = -0.21;
  home.step(readings, 0.01);
  EXPECT_EQ(
      home.failure(),
      "supraspinatus: winds the wrong way, from 0.30 to -0.21 rad: check the polarity of motor "
      "and encoder");
}

TEST_F(HomeTest, ATightTendonMayPayOutDownToThePretension) {
  Home home(rig.hardware);
  std::vector<Home::Reading> readings(rig.hardware.muscles.size(), {0.3, 15.0});
  home.start(0.0);
  home.step(readings, 0.0);
  readings[3] = {-0.4, 5.0};
  home.step(readings, 0.005);
  EXPECT_TRUE(home.running()) << home.failure().value_or("");
}

TEST_F(HomeTest, AForceSensorThatDoesNotFollowEndsItEitherWay) {
  for (const double force : {8.0, 4.0}) {
    const double turn = force > 5.0 ? -1.0 : 1.0;
    Home home(rig.hardware);
    std::vector<Home::Reading> readings(rig.hardware.muscles.size(), {0.3, 5.0});
    readings[3].force = force;
    home.start(0.0);
    for (double t = 0.0; home.running() && std::abs(readings[3].position - 0.3) < 7.0; t += 0.005) {
      home.step(readings, t);
      readings[3].position += 0.07 * turn;
    }
    char expected[160];
    std::snprintf(
        expected, sizeof(expected),
        "supraspinatus: turned by %.2f rad since its tendon gripped, and reads %.1f N: the force "
        "sensor does not follow",
        6.02 * turn, force);
    EXPECT_EQ(home.failure(), expected);
  }
}

TEST_F(HomeTest, ASlackMuscleThatPaysOutWindsTheWrongWay) {
  Home home(rig.hardware);
  std::vector<Home::Reading> readings(rig.hardware.muscles.size(), {0.0, 5.0});
  readings[3].force = 0.0;
  home.start(0.0);
  home.step(readings, 0.0);
  readings[3].position = -0.6;
  home.step(readings, 0.005);
  EXPECT_NE(home.failure().value_or("").find("supraspinatus"), std::string::npos)
      << home.failure().value_or("");
  EXPECT_NE(home.failure().value_or("").find("winds the wrong way"), std::string::npos)
      << home.failure().value_or("");
}

TEST_F(HomeTest, ATravelBeforeItGrippedIsNoneAfterIt) {
  Home home(rig.hardware);
  std::vector<Home::Reading> readings(rig.hardware.muscles.size(), {0.0, 5.0});
  readings[3].force = 0.0;
  home.start(0.0);
  home.step(readings, 0.0);
  readings[3].position = 5.9;
  home.step(readings, 0.005);
  readings[3] = {6.5, 4.5};
  home.step(readings, 0.01);
  EXPECT_TRUE(home.running()) << home.failure().value_or("");
}

TEST_F(HomeTest, AMotorWiredTheWrongWayStopsBeforeItPaysOutItsTendon) {
  rig.plant.reverse(3);
  home();
  EXPECT_NE(failure().find("supraspinatus"), std::string::npos) << failure();
  EXPECT_NE(failure().find("counts backwards"), std::string::npos) << failure();
  rig.run(20);
  EXPECT_EQ(rig.moving(), 0);
  EXPECT_GT(rig.plant.muscle(3).position, -1.5);
}

TEST_F(HomeTest, AJammedMotorIsAFaultOfItsEcu) {
  rig.plant.jam(5);
  home();
  // Its encoder stands still under volts: the ECU finds that first.
  EXPECT_NE(failure().find("ecu_3"), std::string::npos) << failure();
}

TEST_F(HomeTest, AnEmergencyStopEndsIt) {
  ASSERT_TRUE(rig.driver().start_home(rig.now()).accepted);
  rig.run(500);
  EXPECT_GT(rig.moving(), 0);
  rig.driver().emergency_stop();
  rig.run(3);
  EXPECT_EQ(rig.moving(), 0);
  EXPECT_FALSE(rig.driver().home().running());
  EXPECT_EQ(failure(), "emergency stop");
  rig.run(1000);
  EXPECT_EQ(rig.moving(), 0);
}

TEST_F(HomeTest, AnEmergencyStopFromElsewhereEndsItToo) {
  ASSERT_TRUE(rig.driver().start_home(rig.now()).accepted);
  rig.run(500);
  rig.stranger.send(ecu::Frame{});
  rig.run(10);
  EXPECT_EQ(rig.moving(), 0);
  EXPECT_EQ(failure(), "a STOP frame came from elsewhere on the bus");
  EXPECT_EQ(rig.driver().last_outcome().reason, failure());
}

TEST_F(HomeTest, AnAnswerMissingAtTheStartDoesNotDriveAMuscleElsewhere) {
  const EcuHardware& ecu = rig.hardware.ecus[1];
  const auto muscle = static_cast<std::size_t>(ecu.muscles[0]);
  // Far from position 0, where a reference that is not a number would send it.
  rig.plant.slacken(muscle, 1e3);
  rig.driver().command({rig.hardware.muscles[muscle].name}, {0}, {5.0}, rig.now());
  rig.run(400);
  rig.driver().disable();
  rig.run(200);
  const double start = rig.plant.muscle(muscle).position;
  ASSERT_GT(start, 1.0);
  rig.plant.slacken(muscle, start + 1.0);
  ASSERT_TRUE(rig.enable());
  while (rig.ms % rig.period_ms != 1) rig.step();
  int drop = 1;
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    const bool motion = ecu::function_of(f) == static_cast<int>(ecu::Function::kMotionA) &&
                        ecu::node_of(f) == ecu.node;
    return motion && drop-- > 0 ? std::vector<ecu::Frame>{} : std::vector<ecu::Frame>{f};
  };
  while (drop > 0) rig.step();
  rig.run(rig.period_ms - 1);
  ASSERT_TRUE(rig.driver().start_home(rig.now()).accepted);
  double lowest = start;
  for (int ms = 0; ms < 30000 && rig.driver().home().running(); ++ms) {
    rig.step();
    lowest = std::min(lowest, rig.plant.muscle(muscle).position);
  }
  EXPECT_EQ(failure(), "");
  EXPECT_GT(lowest, start - 0.1);
}

TEST_F(HomeTest, NamesAMuscleThatIsNeverMeasured) {
  Home home(rig.hardware);
  std::vector<Home::Reading> readings(rig.hardware.muscles.size(), {0.0, 0.0});
  readings[3] = {std::nan(""), std::nan("")};
  home.start(0.0);
  for (double t = 0.0; home.running() && t < 60.0; t += 0.005) {
    home.step(readings, t);
    EXPECT_EQ(home.command(3, t).mode, ecu::Mode::kVoltage);
  }
  EXPECT_EQ(home.failure(),
            "supraspinatus: not measured within time_limit, so home could not start");
}

TEST_F(HomeTest, SaysWhyItEndsWhereAllAreTightTooLate) {
  HomeRoutine& routine = rig.hardware.home;
  Home home(rig.hardware);
  std::vector<Home::Reading> readings(rig.hardware.muscles.size(), {0.0, 0.0});
  home.start(0.0);
  for (double t = 0.0; home.running() && t < 60.0; t += 0.005) {
    const bool tight = t > routine.time_limit - 0.5 * routine.settle_time;
    for (Home::Reading& reading : readings) reading.force = tight ? routine.pretension : 0.0;
    home.step(readings, t);
  }
  EXPECT_EQ(home.failure(),
            "after 20.0 s (time_limit) not all muscles had held 5.0 N for settle_time");
}

TEST_F(HomeTest, NamesAMuscleWhoseForceIsNoLongerMeasured) {
  Home home(rig.hardware);
  std::vector<Home::Reading> readings(rig.hardware.muscles.size(), {0.0, 0.0});
  home.start(0.0);
  home.step(readings, 0.0);
  readings[3].force = std::nan("");
  home.step(readings, 0.005);
  EXPECT_EQ(home.failure(), "supraspinatus: its force is no longer measured");
}

TEST_F(HomeTest, CommandsThatWereSentBeforeDoNotTimeOutMeanwhile) {
  rig.command();
  rig.run(100);
  home();
  EXPECT_EQ(failure(), "");
  EXPECT_EQ(rig.driver().phase(), RobotDriver::Phase::kEnabled);
  // From its end on they are watched again.
  rig.run(400);
  EXPECT_EQ(rig.driver().phase(), RobotDriver::Phase::kEnabled);
  rig.run(200);
  EXPECT_EQ(rig.driver().phase(), RobotDriver::Phase::kDisabled);
  EXPECT_EQ(rig.driver().findings().count(Finding::kCommandTimeout), 1u);
}

TEST_F(HomeTest, CommandsAreWatchedAfterwardsThoughNoneCameBefore) {
  home();
  EXPECT_EQ(failure(), "");
  rig.run(400);
  EXPECT_EQ(rig.driver().phase(), RobotDriver::Phase::kEnabled);
  rig.run(200);
  EXPECT_EQ(rig.driver().phase(), RobotDriver::Phase::kDisabled);
  EXPECT_EQ(rig.driver().findings().count(Finding::kCommandTimeout), 1u);
  EXPECT_EQ(rig.moving(), 0);
}

TEST_F(HomeTest, AUnitThatRestartedTakesNoPositionsBeforeIt) {
  restart(2);
  const auto infraspinatus = command("infraspinatus", ecu::Mode::kPosition, 1.0);
  EXPECT_FALSE(infraspinatus.accepted);
  EXPECT_EQ(infraspinatus.reason, "muscle 'infraspinatus': ecu_3 has no zero: call home first");
  EXPECT_EQ(rig.driver().supervisor().last_rejection(), infraspinatus.reason);
  EXPECT_FALSE(command("teres_minor", ecu::Mode::kPosition, 1.0).accepted);
  EXPECT_TRUE(command("infraspinatus", ecu::Mode::kVoltage, 0.0).accepted);
  EXPECT_TRUE(command("infraspinatus", ecu::Mode::kForce, 2.0).accepted);
  EXPECT_TRUE(command("brachialis", ecu::Mode::kPosition, 0.0).accepted);
  // Nor does another clear, or another enable, bring the zero back.
  rig.driver().disable();
  rig.driver().clear_faults(rig.now());
  rig.run(200);
  ASSERT_TRUE(rig.enable());
  EXPECT_FALSE(command("infraspinatus", ecu::Mode::kPosition, 1.0).accepted);
  home();
  ASSERT_EQ(failure(), "");
  EXPECT_TRUE(command("infraspinatus", ecu::Mode::kPosition, 1.0).accepted);
}

TEST_F(HomeTest, ASpindleThatMayHaveTurnedUncountedTakesNoPositionsBeforeIt) {
  const auto muscle = static_cast<std::size_t>(rig.hardware.ecus[2].muscles.front());
  const std::string& name = rig.hardware.muscles[muscle].name;
  ASSERT_TRUE(command(name, ecu::Mode::kPosition, 0.0).accepted);
  rig.plant.jam(muscle);
  ASSERT_TRUE(command(name, ecu::Mode::kVoltage, 8.0).accepted);
  rig.run(400);
  ASSERT_EQ(rig.driver().phase(), RobotDriver::Phase::kDisabled);
  EXPECT_NE(rig.driver().stops().last().value_or("").find("ecu_3: an ECU reports a fault"),
            std::string::npos);
  EXPECT_NE(rig.driver().stops().last().value_or("").find("(encoder of " + name + ")"),
            std::string::npos)
      << rig.driver().stops().last().value_or("");
  rig.driver().clear_faults(rig.now());
  rig.run(200);
  EXPECT_EQ(rig.driver().findings().count(Finding::kEcuFault), 0u) << "it was cleared";
  ASSERT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
  EXPECT_EQ(command(name, ecu::Mode::kPosition, 0.0).reason,
            "muscle '" + name + "': ecu_3 has no zero: call home first");
  EXPECT_TRUE(command(name, ecu::Mode::kForce, 2.0).accepted);
  EXPECT_TRUE(command("brachialis", ecu::Mode::kPosition, 0.0).accepted);
}

TEST_F(HomeTest, AHomeThatFailedBringsNoZeroBack) {
  restart(2);
  rig.plant.cut(3);
  home();
  ASSERT_NE(failure(), "");
  rig.run(100);
  ASSERT_TRUE(rig.enable());
  EXPECT_FALSE(command("infraspinatus", ecu::Mode::kPosition, 1.0).accepted);
}

TEST_F(HomeTest, ATendonThatBreaksWhileZerosAreWrittenGetsNoZero) {
  const MuscleHardware& broken = rig.hardware.muscles[3];
  bool cut = false;
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    if (!cut && ecu::function_of(f) == static_cast<int>(ecu::Function::kParameterRequest) &&
        ecu::decode_parameter(f).index == ecu::kPresentPosition) {
      rig.plant.cut(3);
      cut = true;
    }
    return std::vector<ecu::Frame>{f};
  };
  home();
  ASSERT_TRUE(cut);
  EXPECT_EQ(failure().rfind(broken.name + ": held", 0), 0u) << failure();
  rig.bus.tamper = nullptr;
  rig.run(300);
  ASSERT_TRUE(rig.enable());
  EXPECT_FALSE(command(broken.name, ecu::Mode::kPosition, 0.0).accepted);
}

TEST_F(HomeTest, AnInterruptedWriteOfZerosLosesThoseThatAreNotConfirmed) {
  // One unit takes its zero, and nobody hears that it did.
  const int node = rig.hardware.ecus[2].node;
  int unheard = 0;
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    const bool lost = ecu::function_of(f) == static_cast<int>(ecu::Function::kParameterReply) &&
                      ecu::node_of(f) == node;
    unheard += lost;
    return lost ? std::vector<ecu::Frame>{} : std::vector<ecu::Frame>{f};
  };
  ASSERT_TRUE(rig.driver().start_home(rig.now()).accepted);
  while (unheard == 0 && rig.driver().home().running()) rig.step();
  ASSERT_GT(unheard, 0);
  rig.run(40);
  rig.driver().emergency_stop();
  rig.bus.tamper = nullptr;
  rig.run(20);
  rig.driver().clear_faults(rig.now());
  rig.run(200);
  ASSERT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
  EXPECT_EQ(command("infraspinatus", ecu::Mode::kPosition, 0.0).reason,
            "muscle 'infraspinatus': ecu_3 has no zero: call home first");
  EXPECT_TRUE(command("infraspinatus", ecu::Mode::kForce, 2.0).accepted);
  EXPECT_TRUE(command("anterior_deltoid", ecu::Mode::kPosition, 0.0).accepted);  // confirmed
  EXPECT_FALSE(command("brachialis", ecu::Mode::kPosition, 0.0).accepted);       // not asked yet
  EXPECT_TRUE(command(rig.hardware.muscles[11].name, ecu::Mode::kPosition, 0.0).accepted);
  rig.driver().disable();
  rig.run(100);
  ASSERT_TRUE(rig.enable());
  home();
  ASSERT_EQ(failure(), "");
  EXPECT_TRUE(command("infraspinatus", ecu::Mode::kPosition, 0.0).accepted);
}

TEST_F(HomeTest, ARestartedHandIsZeroWhereItIs) {
  const std::string& muscle = rig.hardware.muscles[11].name;
  restart(6);
  EXPECT_FALSE(command(muscle, ecu::Mode::kPosition, 1.0).accepted);
  rig.plant.slacken(11, 1e3);
  ASSERT_TRUE(command(muscle, ecu::Mode::kVoltage, 4.0).accepted);
  rig.run(300);
  ASSERT_TRUE(command(muscle, ecu::Mode::kVoltage, 0.0).accepted);
  rig.run(200);
  ASSERT_GT(std::abs(rig.samples.back().muscles[11].position), 0.5);
  home();
  ASSERT_EQ(failure(), "");
  rig.run(20);
  EXPECT_NEAR(rig.samples.back().muscles[11].position, 0.0, 0.05);
  EXPECT_TRUE(command(muscle, ecu::Mode::kPosition, 0.0).accepted);
}

/// At the end of its range a muscle cannot wind in by travel_limit.
TEST(HomeNearTheEndOfARange, ATendonThatDoesNotGripInTimeHasNoZero) {
  Hardware robot = load_hardware(ANTHROB_CONFIG_DIR "/anthrob/hardware.yaml", true);
  MuscleHardware& muscle = robot.muscles[3];
  muscle.home_position =
      muscle.parameters.get(ecu::Parameter::kPositionHigh) - 0.5 * robot.home.travel_limit;
  Rig rig(robot);
  rig.run(1000);
  ASSERT_TRUE(rig.enable());
  const auto home = [&] {
    EXPECT_TRUE(rig.driver().start_home(rig.now()).accepted);
    for (int ms = 0; ms < 30000 && rig.driver().home().running(); ++ms) rig.step();
    rig.run(100);
    return rig.driver().home().failure().value_or("");
  };
  const auto takes_positions = [&] {
    const auto mode = static_cast<std::uint8_t>(ecu::Mode::kPosition);
    return rig.driver().command({muscle.name}, {mode}, {muscle.home_position}, rig.now()).accepted;
  };
  ASSERT_EQ(home(), "");
  EXPECT_TRUE(takes_positions());
  rig.driver().disable();
  rig.plant.cut(3);
  rig.run(1000);
  ASSERT_TRUE(rig.enable());
  EXPECT_TRUE(takes_positions());
  const std::string failure = home();
  EXPECT_NE(failure.find("were not reached by supraspinatus"), std::string::npos) << failure;
  ASSERT_TRUE(rig.enable());
  EXPECT_FALSE(takes_positions());
}

TEST(HomeOfTheCarefulRobot, Succeeds) {
  Rig rig(load_hardware(ANTHROB_CONFIG_DIR "/anthrob/hardware_careful.yaml", true));
  for (std::size_t m = 0; m < rig.hardware.muscles.size(); ++m) rig.plant.slacken(m, 1.0);
  rig.run(1000);
  ASSERT_TRUE(rig.enable());
  ASSERT_TRUE(rig.driver().start_home(rig.now()).accepted);
  for (int ms = 0; ms < 30000 && rig.driver().home().running(); ++ms) rig.step();
  EXPECT_EQ(rig.driver().home().failure(), std::nullopt);
  EXPECT_EQ(rig.driver().phase(), RobotDriver::Phase::kEnabled);
}

TEST_F(HomeTest, CommandsAreRefusedMeanwhile) {
  ASSERT_TRUE(rig.driver().start_home(rig.now()).accepted);
  const auto outcome = rig.driver().command({"brachialis"}, {0}, {1.0}, rig.now());
  EXPECT_FALSE(outcome.accepted);
  EXPECT_EQ(outcome.reason, "home is running");
  EXPECT_EQ(rig.driver().supervisor().last_rejection(), "home is running");
  EXPECT_EQ(rig.driver().supervisor().rejected_count(), 1u);
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
