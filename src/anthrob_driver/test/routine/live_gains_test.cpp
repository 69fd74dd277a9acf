// Gains changed while the robot runs, on a bus that may lose frames.
#include "routine/live_gains.h"

#include <gtest/gtest.h>

#include "rig.h"

namespace anthrob {
namespace driver {
namespace {

using ecu::Parameter;
using Phase = RobotDriver::Phase;

class LiveGainsTest : public testing::Test {
 protected:
  /// @return why it was refused or failed; empty: it was not
  std::string change(const std::string& muscle, const std::string& gain, double value) {
    const auto outcome = rig.driver().start_gains({muscle}, {gain}, {value}, rig.now());
    if (!outcome.accepted) return outcome.reason;
    for (int ms = 0; ms < 10000 && rig.driver().gains().changing(); ++ms) rig.step();
    EXPECT_FALSE(rig.driver().gains().changing());
    return rig.driver().gains().outcome().reason;
  }
  double held(std::size_t muscle, Parameter gain) {
    const MuscleHardware& wired = rig.hardware.muscles[muscle];
    const auto unit = static_cast<std::size_t>(wired.ecu);
    return rig.rack.board(unit).firmware().channel(wired.channel).parameters.get(gain);
  }
  double believed(std::size_t muscle, Parameter gain) {
    return rig.driver().hardware().muscles[muscle].parameters.get(gain);
  }
  bool all_configured() {
    bool all = true;
    for (std::size_t e = 0; e < rig.rack.size(); ++e) all &= rig.driver().link(e).configured();
    return all;
  }
  /// Writes of this gain do not arrive, or their answers do not come back.
  void lose(Parameter gain, ecu::Function function) {
    rig.bus.tamper = [gain, function](const ecu::Frame& f, const MemoryBus::Port&) {
      const bool lost = ecu::function_of(f) == static_cast<int>(function) &&
                        ecu::decode_parameter(f).index == static_cast<std::uint8_t>(gain);
      return lost ? std::vector<ecu::Frame>{} : std::vector<ecu::Frame>{f};
    };
  }

  Rig rig;
};

TEST_F(LiveGainsTest, ChangeInMotionAndTheRobotGoesOn) {
  ASSERT_TRUE(rig.start());
  EXPECT_EQ(change("supraspinatus", "position_proportional", 3.25), "");
  EXPECT_EQ(held(3, Parameter::kPositionProportional), 3.25);
  EXPECT_EQ(believed(3, Parameter::kPositionProportional), 3.25);
  EXPECT_NE(held(2, Parameter::kPositionProportional), 3.25);
  rig.run(200);  // the unit says what it holds now and then
  EXPECT_TRUE(all_configured());
  EXPECT_EQ(rig.driver().phase(), Phase::kEnabled);
  EXPECT_EQ(rig.moving(), 13);
  // All muscles at once; the next enable finds the units as it wants them.
  EXPECT_EQ(change("", "force_integral", 0.5), "");
  for (std::size_t m = 0; m < 13; ++m) EXPECT_EQ(held(m, Parameter::kForceIntegral), 0.5);
  rig.driver().disable();
  rig.run(2000);
  EXPECT_EQ(held(3, Parameter::kPositionProportional), 3.25);
  EXPECT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
  EXPECT_EQ(rig.driver().findings().count(Finding::kConfigurationRefused), 0u);
}

TEST_F(LiveGainsTest, ChangeTheVoltageOfTheNextTick) {
  ASSERT_TRUE(rig.start());
  rig.modes.assign(13, static_cast<std::uint8_t>(ecu::Mode::kPosition));
  rig.volts.assign(13, 0.0);
  for (std::size_t m = 0; m < 13; ++m) rig.volts[m] = rig.plant.muscle(m).position + 1.0;
  rig.run(100);
  EXPECT_GT(std::abs(rig.plant.voltage(3)), 0.0);
  for (const char* gain :
       {"position_proportional", "position_derivative", "position_force_feedforward"}) {
    EXPECT_EQ(change("supraspinatus", gain, 0.0), "");
  }
  rig.run(20);
  EXPECT_EQ(rig.plant.voltage(3), 0.0);
  EXPECT_NE(rig.plant.voltage(4), 0.0);
}

TEST_F(LiveGainsTest, ChangeWhileDisabledAndAfterARestartOfTheUnit) {
  rig.run(1000);
  EXPECT_EQ(change("brachialis", "current_integral", 123.0), "");
  const auto unit = static_cast<std::size_t>(rig.hardware.muscles[10].ecu);
  rig.rack.board(unit).set_power(false);
  rig.run(100);
  EXPECT_NE(change("brachialis", "current_integral", 7.0), "");
  rig.rack.board(unit).set_power(true);
  rig.run(3000);
  // It gets what the user wanted last and was confirmed.
  EXPECT_EQ(held(10, Parameter::kCurrentIntegral), 123.0);
  EXPECT_TRUE(all_configured());
}

TEST_F(LiveGainsTest, AreWrittenAgainIfAFrameIsLost) {
  ASSERT_TRUE(rig.start());
  int left = 2;
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    const bool reply =
        ecu::function_of(f) == static_cast<int>(ecu::Function::kParameterReply) && left-- > 0;
    return reply ? std::vector<ecu::Frame>{} : std::vector<ecu::Frame>{f};
  };
  EXPECT_EQ(change("teres_minor", "position_derivative", 0.75), "");
  EXPECT_LE(left, 0);
  EXPECT_EQ(held(5, Parameter::kPositionDerivative), 0.75);
  EXPECT_EQ(rig.driver().phase(), Phase::kEnabled);
}

TEST_F(LiveGainsTest, WhatIsNotConfirmedIsNamedAndTheOldOneComesBack) {
  for (const ecu::Function lost :
       {ecu::Function::kParameterRequest, ecu::Function::kParameterReply}) {
    rig.bus.tamper = nullptr;
    rig.driver().disable();
    rig.run(2000);
    ASSERT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
    const double before = believed(5, Parameter::kPositionDerivative);
    lose(Parameter::kPositionDerivative, lost);
    const std::string why = change("teres_minor", "position_derivative", 0.75);
    EXPECT_NE(why.find("teres_minor: ecu_3 does not confirm position_derivative"),
              std::string::npos)
        << why;
    EXPECT_EQ(believed(5, Parameter::kPositionDerivative), before);
    rig.bus.tamper = nullptr;
    rig.driver().disable();
    rig.run(3000);
    EXPECT_EQ(held(5, Parameter::kPositionDerivative), before);
    EXPECT_TRUE(all_configured());
  }
}

TEST_F(LiveGainsTest, ThatWereNotConfirmedInMotionCanBeTriedAgain) {
  ASSERT_TRUE(rig.start());
  lose(Parameter::kPositionDerivative, ecu::Function::kParameterReply);
  EXPECT_NE(change("teres_minor", "position_derivative", 0.75), "");
  // Another unit's do not suffer from it.
  EXPECT_EQ(change("brachialis", "force_integral", 0.5), "");
  rig.bus.tamper = nullptr;
  EXPECT_EQ(change("teres_minor", "position_derivative", 0.75), "");
  EXPECT_EQ(held(5, Parameter::kPositionDerivative), 0.75);
  rig.run(500);
  EXPECT_TRUE(all_configured());
  EXPECT_EQ(rig.driver().phase(), Phase::kEnabled);
}

TEST_F(LiveGainsTest, EndWhenTheUnitRestartsAmongThem) {
  rig.run(1000);
  ASSERT_TRUE(rig.driver().start_gains({""}, {"force_integral"}, {0.5}, rig.now()).accepted);
  rig.run(15);
  ASSERT_TRUE(rig.driver().gains().changing());
  rig.rack.board(0).set_power(false);
  rig.rack.board(0).set_power(true);
  rig.run(400);
  EXPECT_FALSE(rig.driver().gains().changing());
  EXPECT_EQ(rig.driver().gains().outcome().reason, "ecu_1 restarted");
  rig.run(4000);
  EXPECT_TRUE(all_configured());
}

TEST_F(LiveGainsTest, DoNotWaitForUnitsThatTheyAreNotFor) {
  rig.run(1000);
  rig.rack.board(6).set_power(false);
  rig.run(50);
  rig.rack.board(6).set_power(true);
  for (int ms = 0; ms < 2000 && rig.driver().link(6).configured(); ++ms) rig.step();
  ASSERT_FALSE(rig.driver().link(6).configured());
  EXPECT_EQ(change("lateral_deltoid", "force_integral", 0.5), "");
}

TEST_F(LiveGainsTest, AreRefusedWhereTheyCannotBeWritten) {
  rig.run(20);
  EXPECT_NE(change("brachialis", "current_integral", 1.0).find("is being configured"),
            std::string::npos);
  rig.run(1000);
  EXPECT_EQ(change("nobody", "current_integral", 1.0), "'nobody': expected the name of a muscle");
  ASSERT_TRUE(rig.enable());
  ASSERT_TRUE(rig.driver().start_home(rig.now()).accepted);
  EXPECT_EQ(change("brachialis", "current_integral", 1.0), "home is running");
  rig.driver().disable();
  rig.run(100);
  EXPECT_TRUE(rig.driver().start_gains({""}, {"current_integral"}, {1.0}, rig.now()).accepted);
  EXPECT_EQ(rig.driver().start_gains({""}, {"current_integral"}, {2.0}, rig.now()).reason,
            "gains are being changed already");
  EXPECT_EQ(rig.driver().start_enable(rig.now()).reason,
            "gains are being changed; try again in a second");
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
