#include "anthrob_ecu/gains.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

namespace anthrob {
namespace ecu {
namespace {

/// A motor, a Hill muscle and a ligament.
std::vector<MuscleChannel> muscles() {
  std::vector<MuscleChannel> list(3);
  list[0].name = "motor", list[0].modes = {true, true, true, true};
  list[1].name = "hill", list[1].modes = {true, false, false, false};
  list[2].name = "band", list[2].takes_commands = false;
  return list;
}

std::optional<std::string> refusal(const std::vector<std::string>& names,
                                   const std::vector<std::string>& gains,
                                   const std::vector<double>& values) {
  std::vector<GainChange> changes = {{{9, Parameter::kForceGain}, 1.0}};
  const auto why = read_gain_changes(muscles(), names, gains, values, changes);
  EXPECT_TRUE(changes.empty() || !why);
  return why;
}

TEST(Gains, AreThoseThatMayChangeWhileEnabled) {
  ControllerSettings settings;
  const std::vector<Gain> gains = gains_of(muscles());
  EXPECT_EQ(gains.size(), 9u);
  int places = 0;
  for (const ParameterInfo& info : kParameters) {
    EXPECT_EQ(gain_of(settings, info.parameter) != nullptr, info.live) << info.name;
    places += info.live;
  }
  EXPECT_EQ(places, 9);
  for (const Gain& gain : gains) EXPECT_EQ(gain.muscle, 0);
}

TEST(Gains, ReachTheLawThatTheyBelongTo) {
  ParameterSet set;
  double next = 1.0;
  for (const Gain& gain : gains_of(muscles())) set.set(gain.parameter, next++);
  const ControllerSettings law = set.controller();
  EXPECT_EQ(law.position.proportional, 1.0);
  EXPECT_EQ(law.position.derivative, 2.0);
  EXPECT_EQ(law.position.force_feedforward, 3.0);
  EXPECT_EQ(law.current.proportional, 4.0);
  EXPECT_EQ(law.current.integral, 5.0);
  EXPECT_EQ(law.force.proportional, 6.0);
  EXPECT_EQ(law.force.integral, 7.0);
  EXPECT_EQ(law.force.derivative, 8.0);
  EXPECT_EQ(law.force.force_feedforward, 9.0);
}

TEST(Gains, AreReadForOneMuscleOrAll) {
  std::vector<GainChange> changes;
  EXPECT_FALSE(read_gain_changes(muscles(), {"motor", ""},
                                 {"force_integral", "position_derivative"}, {2.0, 0.25}, changes));
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[0].gain.parameter, Parameter::kForceIntegral);
  EXPECT_EQ(changes[0].value, 2.0);
  EXPECT_EQ(changes[1].gain.parameter, Parameter::kPositionDerivative);
  EXPECT_FALSE(read_gain_changes(muscles(), {}, {}, {}, changes));
  EXPECT_TRUE(changes.empty());
}

TEST(Gains, ThatAreInRangeOnTheBusAreInRange) {
  const double beyond = find_gain("position_proportional")->highest * (1.0 + 1e-9);
  std::vector<GainChange> changes;
  ASSERT_FALSE(
      read_gain_changes(muscles(), {"motor"}, {"position_proportional"}, {beyond}, changes));
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].value, find_gain("position_proportional")->highest);
}

TEST(Gains, ThatAreWrongAreRefusedWhole) {
  const std::string good = "position_proportional";
  EXPECT_EQ(refusal({"motor"}, {good}, {}),
            "muscle, gain and value: 1, 1 and 0 entries: expected the same number of each");
  EXPECT_EQ(refusal({"motor", "nobody"}, {good, good}, {1.0, 1.0}),
            "'nobody': expected the name of a muscle");
  EXPECT_EQ(refusal({"hill"}, {good}, {1.0}), "muscle 'hill' has no gains");
  EXPECT_EQ(refusal({"band"}, {good}, {1.0}), "muscle 'band' has no gains");
  EXPECT_EQ(refusal({"motor"}, {"K_P"}, {1.0}),
            "'K_P': expected the name of a gain; held_gain lists them");
  EXPECT_EQ(refusal({"motor"}, {"voltage_limit"}, {1.0}),
            "'voltage_limit': expected the name of a gain; held_gain lists them");
  EXPECT_EQ(refusal({"motor", ""}, {good, good}, {1.0, -1.0}),
            "muscle 'motor': position_proportional: -1: expected 0 to 1000 V/rad");
  EXPECT_EQ(refusal(std::vector<std::string>(10, "motor"), std::vector<std::string>(10, good),
                    std::vector<double>(10, 1.0)),
            "too many entries: expected at most 9, one for each gain");
  EXPECT_TRUE(refusal({"motor"}, {good}, {std::nan("")}));
  EXPECT_TRUE(refusal({"motor"}, {good}, {1000.1}));
}

}  // namespace
}  // namespace ecu
}  // namespace anthrob
