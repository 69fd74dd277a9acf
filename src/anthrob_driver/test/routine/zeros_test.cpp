// Whether positions mean what they say: the units know, and the driver asks them.
#include "routine/zeros.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "rig.h"

namespace anthrob {
namespace driver {
namespace {

constexpr std::size_t kUnit = 2;  // ecu_3, of infraspinatus and teres_minor
const char* const kNoZero = "muscle 'infraspinatus': ecu_3 has no zero: call home first";

class ZerosTest : public testing::Test {
 protected:
  static bool is_question(const ecu::Frame& f) {
    return ecu::function_of(f) == static_cast<int>(ecu::Function::kParameterRequest) &&
           ecu::decode_parameter(f).index == ecu::kZeroKnown;
  }
  static bool is_answer(const ecu::Frame& f) {
    return ecu::function_of(f) == static_cast<int>(ecu::Function::kParameterReply) &&
           ecu::decode_parameter(f).index == ecu::kZeroKnown;
  }
  void SetUp() override {
    for (std::size_t m = 0; m < rig.hardware.muscles.size(); ++m) rig.plant.slacken(m, 1.0);
  }
  RobotDriver::Outcome command(const std::string& muscle, ecu::Mode mode, double reference) {
    return rig.driver().command({muscle}, {static_cast<std::uint8_t>(mode)}, {reference},
                                rig.now());
  }
  std::string refusal() { return command("infraspinatus", ecu::Mode::kPosition, 0.0).reason; }
  std::string failure() { return rig.driver().home().failure().value_or(""); }
  void enable() {
    rig.driver().disable();
    rig.driver().clear_faults(rig.now());
    rig.run(1000);
    ASSERT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
  }
  void home() {
    ASSERT_TRUE(rig.driver().start_home(rig.now()).accepted);
    for (int ms = 0; ms < 30000 && rig.driver().home().running(); ++ms) rig.step();
    ASSERT_EQ(rig.driver().home().failure(), std::nullopt);
  }

  Rig rig;
};

TEST_F(ZerosTest, UnitsThatWereJustSwitchedOnTakeNoPositionsBeforeHome) {
  rig.power_cycle();
  enable();
  EXPECT_EQ(refusal(), kNoZero);
  for (const MuscleHardware& muscle : rig.hardware.muscles) {
    EXPECT_FALSE(command(muscle.name, ecu::Mode::kPosition, 0.0).accepted) << muscle.name;
    EXPECT_TRUE(command(muscle.name, ecu::Mode::kVoltage, 0.0).accepted) << muscle.name;
  }
  home();
  for (const MuscleHardware& muscle : rig.hardware.muscles) {
    EXPECT_TRUE(command(muscle.name, ecu::Mode::kPosition, 0.0).accepted) << muscle.name;
  }
}

TEST_F(ZerosTest, TheZerosOfHomeLeaveTheBusRoomForTheReferences) {
  enable();
  std::vector<double> written;
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    const bool write = ecu::function_of(f) == static_cast<int>(ecu::Function::kParameterRequest) &&
                       ecu::decode_parameter(f).index == ecu::kPresentPosition;
    if (write) written.push_back(rig.now());
    return std::vector<ecu::Frame>{f};
  };
  home();
  const auto& muscles = rig.hardware.muscles;
  EXPECT_EQ(written.size(), std::count_if(muscles.begin(), muscles.end(), [](const auto& muscle) {
              return muscle.parameters.has_force_sensor();
            }));
  const double least = 1e-3 * rig.period_ms * EcuLink::kCyclesPerWrite;
  for (std::size_t i = 1; i < written.size(); ++i) {
    EXPECT_GT(written[i] - written[i - 1], 0.99 * least) << i;
  }
}

TEST_F(ZerosTest, AConfirmationThatIsOnItsWayDoesNotBringARevokedZeroBack) {
  for (const bool revoked : {false, true}) {
    Findings findings;
    EcuLink link(rig.hardware, static_cast<int>(kUnit), findings);
    link.start_zero();
    const std::string first = link.zeroing().name;
    ecu::Frame frame;
    ASSERT_TRUE(link.next_zero(0.0, frame));
    if (revoked) link.revoke_zero(0);
    ecu::ParameterMessage confirmation = ecu::decode_parameter(frame);
    confirmation.result = ecu::ParameterResult::kOk;
    link.receive(ecu::encode_parameter_reply(confirmation, link.own().node), 0.01);
    EXPECT_EQ(link.zeroing().name == first, revoked);
  }
}

TEST_F(ZerosTest, ADriverThatIsStartedAnewNeedsNoHomeWhileTheUnitsStayOn) {
  rig.power_cycle();
  enable();
  home();
  rig.restart_driver();
  enable();
  EXPECT_EQ(refusal(), "");
}

TEST_F(ZerosTest, ADriverThatIsStartedAnewLearnsOfAZeroThatWasLostBefore) {
  enable();
  ASSERT_EQ(refusal(), "");
  rig.plant.jam(4);
  ASSERT_TRUE(command("infraspinatus", ecu::Mode::kVoltage, 8.0).accepted);
  rig.run(400);
  ASSERT_EQ(rig.driver().link(kUnit).report().fault, ecu::Fault::kEncoder);
  rig.restart_driver();
  enable();
  EXPECT_EQ(refusal(), kNoZero);
  EXPECT_TRUE(command("brachialis", ecu::Mode::kPosition, 0.0).accepted);
}

TEST_F(ZerosTest, AZeroThatIsLostWhileItsUnitIsInFaultIsLost) {
  for (const bool turned : {false, true}) {
    enable();
    rig.rack.board(kUnit).peripherals.temperature = 90;
    rig.run(100);
    ASSERT_EQ(rig.driver().link(kUnit).report().fault, ecu::Fault::kOverTemperature);
    if (turned) rig.plant.turn(4, -10.0);  // slack: no force on its sensor
    rig.run(100);
    ASSERT_EQ(rig.driver().link(kUnit).report().fault, ecu::Fault::kOverTemperature);
    rig.rack.board(kUnit).peripherals.temperature = 30;
    enable();
    EXPECT_EQ(refusal(), turned ? kNoZero : "");
    EXPECT_TRUE(command("brachialis", ecu::Mode::kPosition, 0.0).accepted);
  }
}

TEST_F(ZerosTest, AHomeThatWasInterruptedIsRememberedByTheUnits) {
  enable();
  // One unit takes its zero, and nobody hears that it did.
  int unheard = 0;
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    const bool lost = ecu::function_of(f) == static_cast<int>(ecu::Function::kParameterReply) &&
                      ecu::node_of(f) == rig.hardware.ecus[kUnit].node;
    unheard += lost;
    return lost ? std::vector<ecu::Frame>{} : std::vector<ecu::Frame>{f};
  };
  ASSERT_TRUE(rig.driver().start_home(rig.now()).accepted);
  while (unheard == 0 && rig.driver().home().running()) rig.step();
  rig.driver().disable();
  rig.run(200);
  rig.bus.tamper = nullptr;
  rig.run(200);
  rig.restart_driver();
  enable();
  EXPECT_EQ(refusal(), kNoZero);
  EXPECT_TRUE(command("anterior_deltoid", ecu::Mode::kPosition, 0.0).accepted);
  EXPECT_FALSE(command("brachialis", ecu::Mode::kPosition, 0.0).accepted);  // was not asked yet
}

TEST_F(ZerosTest, ATendonThatBrokeTakesTheZeroOfItsMuscleAlong) {
  rig.plant.slacken(4, 0.0);
  enable();
  rig.commander_runs = true;
  rig.modes[4] = static_cast<std::uint8_t>(ecu::Mode::kPosition);
  rig.volts[4] = 1.5;
  rig.run(3000);
  rig.plant.cut(4);
  rig.run(300);
  rig.commander_runs = false;
  ASSERT_EQ(rig.driver().findings().count(Finding::kTendonSlack), 1u);
  enable();
  EXPECT_EQ(refusal(), kNoZero);
  EXPECT_TRUE(command("brachialis", ecu::Mode::kPosition, 0.0).accepted);
  // The tendon is mended while no driver runs: the unit remembers.
  EXPECT_FALSE(rig.rack.board(kUnit).firmware().channel(0).zero_known());
  EXPECT_TRUE(rig.rack.board(kUnit).firmware().channel(1).zero_known());
  rig.restart_driver();
  enable();
  EXPECT_EQ(refusal(), kNoZero);
}

TEST_F(ZerosTest, AnAnswerFromBeforeItWasLostDoesNotKeepItFromTheUnit) {
  rig.restart_driver();
  // The units' answers about their zeros get lost, so that the driver keeps asking.
  std::vector<ecu::Frame> lost;
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    if (!is_answer(f) || ecu::node_of(f) != rig.hardware.ecus[kUnit].node)
      return std::vector<ecu::Frame>{f};
    lost.push_back(f);
    return std::vector<ecu::Frame>{};
  };
  enable();
  rig.commander_runs = true;
  rig.volts[4] = 2.0;
  rig.rack.board(kUnit).peripherals.encoder = Board::Peripherals::Encoder::kCut;
  for (int ms = 0; ms < 400 && rig.driver().findings().count(Finding::kEncoderDead) == 0; ++ms) {
    rig.step();
  }
  rig.commander_runs = false;
  ASSERT_EQ(rig.driver().findings().count(Finding::kEncoderDead), 1u);
  ASSERT_FALSE(lost.empty());
  rig.bus.tamper = nullptr;
  rig.stranger.send(lost.back());
  rig.run(300);
  EXPECT_FALSE(rig.rack.board(kUnit).firmware().channel(0).zero_known());
}

TEST_F(ZerosTest, AnEncoderThatDiesTakesTheZeroAlong) {
  enable();
  rig.commander_runs = true;
  rig.volts[4] = 2.0;
  rig.rack.board(kUnit).peripherals.encoder = Board::Peripherals::Encoder::kCut;
  rig.run(400);
  rig.commander_runs = false;
  ASSERT_EQ(rig.driver().findings().count(Finding::kEncoderDead), 1u);
  EXPECT_EQ(rig.driver().stops().last().value_or("").substr(0, 20), "encoder_dead: ecu_3:");
  EXPECT_NE(rig.driver().stops().last().value_or("").find("infraspinatus: at 2.0 V"),
            std::string::npos)
      << rig.driver().stops().last().value_or("");
  rig.rack.board(kUnit).peripherals.encoder = Board::Peripherals::Encoder::kCounts;
  enable();
  EXPECT_EQ(refusal(), kNoZero);
  EXPECT_TRUE(command("brachialis", ecu::Mode::kPosition, 0.0).accepted);
}

TEST_F(ZerosTest, ATendonThatHomeFindsBrokenTakesTheZeroAlong) {
  enable();
  rig.plant.slacken(4, 1e3);
  ASSERT_TRUE(rig.driver().start_home(rig.now()).accepted);
  rig.run(10000);
  ASSERT_NE(failure().find("infraspinatus: wound in"), std::string::npos) << failure();
  enable();
  EXPECT_EQ(refusal(), kNoZero);
  EXPECT_TRUE(command("brachialis", ecu::Mode::kPosition, 0.0).accepted);
  rig.plant.slacken(4, rig.plant.muscle(4).position + 1.0);
  home();
  EXPECT_EQ(refusal(), "");
}

TEST_F(ZerosTest, ATendonThatSlipsInHomeTakesTheZeroAlong) {
  enable();
  rig.plant.slacken(4, 0.3);
  rig.plant.slacken(9, 5.0);  // keeps the others waiting
  ASSERT_TRUE(rig.driver().start_home(rig.now()).accepted);
  rig.run(4000);
  rig.plant.slacken(4, 9.0);
  rig.run(1000);
  ASSERT_NE(failure().find("infraspinatus: held 5.0 N"), std::string::npos) << failure();
  enable();
  EXPECT_EQ(refusal(), kNoZero);
  EXPECT_TRUE(command("brachialis", ecu::Mode::kPosition, 0.0).accepted);
}

TEST_F(ZerosTest, AHomeThatFailsOtherwiseLeavesTheZeros) {
  enable();
  ASSERT_TRUE(rig.driver().start_home(rig.now()).accepted);
  rig.plant.slacken(4, -5.0);  // more than force_limit
  rig.run(2000);
  ASSERT_NE(failure().find("unwind it by hand"), std::string::npos) << failure();
  rig.plant.slacken(4, 1.0);
  enable();
  EXPECT_EQ(refusal(), "");
}

TEST_F(ZerosTest, EveryMuscleIsAskedOnceASession) {
  int asked = 0;
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    asked += is_question(f);
    EXPECT_FALSE(is_question(f) && !rig.driver().link(0).heard());
    return std::vector<ecu::Frame>{f};
  };
  rig.run(1000);
  EXPECT_EQ(asked, 13);
  ASSERT_TRUE(rig.start());
  rig.run(2000);
  EXPECT_EQ(asked, 13);
  rig.rack.board(kUnit).set_power(false);
  rig.rack.board(kUnit).set_power(true);
  rig.run(1000);
  EXPECT_EQ(asked, 15);
}

TEST_F(ZerosTest, WithoutAnAnswerThereIsNoZeroAndTheQuestionGoesOnWhileEnabled) {
  bool drop = true;
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    const bool lost = drop && is_answer(f) && ecu::node_of(f) == rig.hardware.ecus[kUnit].node;
    return lost ? std::vector<ecu::Frame>{} : std::vector<ecu::Frame>{f};
  };
  enable();
  EXPECT_EQ(refusal(), kNoZero);
  EXPECT_TRUE(command("brachialis", ecu::Mode::kPosition, 0.0).accepted);
  drop = false;
  rig.run(200);
  EXPECT_EQ(refusal(), "");
}

TEST_F(ZerosTest, AUnitThatDoesNotUnderstandTheQuestionNeedsAHome) {
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    if (!is_answer(f)) return std::vector<ecu::Frame>{f};
    ecu::ParameterMessage reply = ecu::decode_parameter(f);
    reply.result = ecu::ParameterResult::kUnknown;
    return std::vector<ecu::Frame>{ecu::encode_parameter_reply(reply, ecu::node_of(f))};
  };
  enable();
  EXPECT_EQ(refusal(), kNoZero);
  home();
  EXPECT_EQ(refusal(), "");
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
