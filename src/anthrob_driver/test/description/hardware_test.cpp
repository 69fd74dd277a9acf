#include "anthrob_driver/hardware.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace driver {
namespace {

namespace fs = std::filesystem;
using ecu::Parameter;

const fs::path kConfig = ANTHROB_CONFIG_DIR "/anthrob";

TEST(Hardware, AnthrobWithAndWithoutHand) {
  const Hardware arm = load_hardware(kConfig / "hardware.yaml", false);
  EXPECT_EQ(arm.muscles.size(), 11u);
  EXPECT_EQ(arm.ecus.size(), 6u);
  EXPECT_EQ(arm.idle_nodes, std::vector<int>{7});
  EXPECT_TRUE(arm.touch.empty());
  const Hardware all = load_hardware(kConfig / "hardware.yaml", true);
  EXPECT_EQ(all.muscles.size(), 13u);
  EXPECT_EQ(all.ecus.size(), 7u);
  EXPECT_EQ(all.touch.size(), 4u);
  EXPECT_EQ(all.muscles[12].name, "hand_antagonist");
  EXPECT_FALSE(all.muscles[12].parameters.has_force_sensor());
  EXPECT_FALSE(all.muscles[12].limits.modes[3]);
}

TEST(Hardware, AnthrobWithoutItsForearm) {
  const Hardware upper = load_hardware(kConfig / "hardware_tier1.yaml", false);
  EXPECT_EQ(upper.muscles.size(), 8u);
  EXPECT_EQ(upper.ecus.size(), 4u);
  EXPECT_EQ(upper.idle_nodes, (std::vector<int>{5, 6, 7}));
  EXPECT_TRUE(upper.joints.empty());
  for (const char* name : {"model_I_tier1.yaml", "model_III_tier1.yaml"}) {
    const Hardware other = load_hardware(kConfig / "hardware_tier1.yaml", false, kConfig / name);
    EXPECT_EQ(difference(upper, other), std::nullopt) << name;
  }
  // A muscle that both have is wired and limited alike.
  Hardware arm = load_hardware(kConfig / "hardware.yaml", false);
  arm.muscles.resize(8);
  EXPECT_EQ(difference(upper, arm), std::nullopt);
}

TEST(Hardware, ARobotWithoutHand) {
  const std::string file = ANTHROB_CONFIG_DIR "/two_muscle_rig/hardware.yaml";
  EXPECT_FALSE(has_hand(file));
  EXPECT_TRUE(has_hand(kConfig / "hardware.yaml"));
  const Hardware rig = load_hardware(file, false);
  EXPECT_EQ(rig.muscles.size(), 2u);
  EXPECT_EQ(rig.muscles[1].channel, 1);
  EXPECT_EQ(rig.joints.size(), 1u);
  EXPECT_TRUE(rig.idle_nodes.empty());
  EXPECT_THROW(load_hardware(file, true), BadInput);
}

TEST(Hardware, GainsAndLimitsAreTheModels) {
  const Hardware arm = load_hardware(kConfig / "hardware.yaml", false);
  const MuscleHardware& triceps = arm.muscles[9];
  EXPECT_EQ(triceps.name, "triceps_brachii");
  EXPECT_FLOAT_EQ(static_cast<float>(triceps.parameters.get(Parameter::kPositionProportional)),
                  1.4323945f);
  EXPECT_EQ(triceps.limits.highest[3], 100.0);
  EXPECT_EQ(arm.ecus[static_cast<std::size_t>(triceps.ecu)].name, "ecu_5");
  EXPECT_EQ(triceps.channel, 1);
}

TEST(Hardware, MotorsAreTheModels) {
  const Hardware arm = load_hardware(kConfig / "hardware.yaml", true);
  EXPECT_DOUBLE_EQ(arm.muscles[0].resistance, 0.67 + 0.12);  // lateral_deltoid, RE-25
  EXPECT_DOUBLE_EQ(arm.muscles[0].winch.back_emf, 0.0115 * 128.0);
  EXPECT_DOUBLE_EQ(arm.muscles[0].winch.inertia, 1.05e-6 * 128.0 * 128.0);
  EXPECT_DOUBLE_EQ(arm.muscles[0].winch.radius, 0.0065);
  EXPECT_DOUBLE_EQ(arm.muscles[9].resistance, 4.69 + 0.12);  // triceps_brachii, A-max 22
  EXPECT_EQ(arm.muscles[11].resistance, 0.0);                // of the hand nothing is known
}

TEST(Hardware, AMuscleMayHaveGainsOfItsOwn) {
  // As anthrob_gains saves them.
  const fs::path file =
      fs::temp_directory_path() / ("anthrob_tuned_" + std::to_string(::getpid()) + ".yaml");
  std::ofstream(file) << "extends: \"" << (kConfig / "model_II.yaml").string()
                      << "\"\nmuscles:\n  teres_minor: {gains: {force_integral: 0.1}}\n";
  const Hardware plain = load_hardware(kConfig / "hardware.yaml", false);
  const Hardware tuned = load_hardware(kConfig / "hardware.yaml", false, file.string());
  std::ofstream(file) << "extends: \"" << (kConfig / "model_II.yaml").string()
                      << "\"\nmuscles:\n  teres_minor: {gains: {voltage_limit: 1}}\n";
  EXPECT_THROW(load_hardware(kConfig / "hardware.yaml", false, file.string()), BadInput);
  fs::remove(file);
  EXPECT_EQ(tuned.muscles[5].parameters.raw(static_cast<int>(Parameter::kForceIntegral)), 0.1f);
  EXPECT_EQ(tuned.muscles[5].parameters.get(Parameter::kPositionProportional),
            plain.muscles[5].parameters.get(Parameter::kPositionProportional));
  EXPECT_EQ(tuned.muscles[4].parameters.get(Parameter::kForceIntegral),
            plain.muscles[4].parameters.get(Parameter::kForceIntegral));
  EXPECT_NE(tuned.ecus[2].configuration, plain.ecus[2].configuration);
  EXPECT_NE(difference(plain, tuned), std::nullopt);
}

TEST(Hardware, TheCarefulRobotIsTheSameButSlow) {
  Hardware careful = load_hardware(kConfig / "hardware_careful.yaml", true);
  const Hardware own = load_hardware(kConfig / "hardware.yaml", true);
  ASSERT_EQ(careful.muscles.size(), own.muscles.size());
  for (std::size_t m = 0; m < own.muscles.size(); ++m) {
    ecu::ParameterSet& slow = careful.muscles[m].parameters;
    EXPECT_EQ(slow.get(Parameter::kPositionRate), 1.0) << own.muscles[m].name;
    EXPECT_EQ(slow.get(Parameter::kForceRate), 20.0) << own.muscles[m].name;
    for (const Parameter rate : {Parameter::kPositionRate, Parameter::kForceRate}) {
      slow.set(rate, own.muscles[m].parameters.get(rate));
    }
  }
  EXPECT_EQ(difference(own, careful), std::nullopt);
}

TEST(Hardware, WhatIsNotSaidOfTendonsIsHomes) {
  const Hardware rig = load_hardware(ANTHROB_CONFIG_DIR "/two_muscle_rig/hardware.yaml", false);
  EXPECT_EQ(rig.tendons.loaded, 20.0);
  EXPECT_EQ(rig.tendons.slack, 2.5);
  EXPECT_EQ(rig.tendons.travel, 12.0);
}

TEST(Hardware, ModelsOfOneRobotAreTheSameToTheDriver) {
  for (const bool hand : {false, true}) {
    const Hardware own = load_hardware(kConfig / "hardware.yaml", hand);
    for (const char* model : {"model_I.yaml", "model_II.yaml", "model_II_noisy.yaml",
                              "model_II_ecu.yaml", "model_II_hand.yaml", "model_III.yaml"}) {
      const Hardware other = load_hardware(kConfig / "hardware.yaml", hand, kConfig / model);
      EXPECT_EQ(difference(own, other), std::nullopt) << model;
    }
  }
}

TEST(Hardware, WithoutALargestForceThereIsNoForceMode) {
  const fs::path model =
      fs::temp_directory_path() / ("anthrob_no_force_" + std::to_string(getpid()) + ".yaml");
  std::ofstream(model) << "extends: " << (kConfig / "model_II.yaml").string()
                       << "\ncontrollers: {type_2: {limits: {force: 0.0}}}\n";
  const Hardware own = load_hardware(kConfig / "hardware.yaml", false);
  const Hardware other = load_hardware(kConfig / "hardware.yaml", false, model);
  fs::remove(model);
  EXPECT_TRUE(own.muscles[9].limits.modes[3]);
  EXPECT_TRUE(other.muscles[0].limits.modes[3]);   // lateral_deltoid: type_1
  EXPECT_FALSE(other.muscles[9].limits.modes[3]);  // triceps_brachii: type_2
  EXPECT_TRUE(other.muscles[9].limits.modes[1]);
}

TEST(Hardware, CommandsBeyondTheUnitsOwnLimitsAreRefused) {
  // The unit would clip them, or stop.
  const fs::path file =
      fs::temp_directory_path() / ("anthrob_narrow_" + std::to_string(getpid()) + ".yaml");
  std::ofstream(file) << "extends: " << (kConfig / "hardware.yaml").string()
                      << "\nmodel: " << (kConfig / "model_II.yaml").string()
                      << "\ncalibration: " << (kConfig / "sensors.yaml").string()
                      << "\nunits: {type_1: {position_range: [-5.0, 7.0], current_limit: 0.5, "
                         "force_limit: 25.0}}\n";
  const Hardware narrow = load_hardware(file, false);
  fs::remove(file);
  const ecu::MuscleChannel& limits = narrow.muscles[0].limits;  // lateral_deltoid: type_1
  EXPECT_EQ(limits.lowest, (std::array<double, 4>{-12.0, -5.0, -0.5, 0.0}));
  EXPECT_EQ(limits.highest, (std::array<double, 4>{12.0, 7.0, 0.5, 25.0}));
}

TEST(Hardware, AModelOfPartOfTheRobotIsAnother) {
  const Hardware own = load_hardware(kConfig / "hardware.yaml", false);
  const Hardware tier1 =
      load_hardware(kConfig / "hardware.yaml", false, kConfig / "model_I_tier1.yaml");
  EXPECT_EQ(difference(own, tier1), "biceps_brachii: missing");
}

TEST(Hardware, ADifferenceNamesMuscleAndWhat) {
  const Hardware own = load_hardware(kConfig / "hardware.yaml", false);
  Hardware other = own;
  other.muscles[3].parameters.set(Parameter::kForceIntegral, 7.5);
  EXPECT_EQ(difference(own, other), "supraspinatus: another value of force_integral");
  other = own;
  other.muscles[3].limits.highest[1] *= 2.0;
  EXPECT_EQ(difference(own, other), "supraspinatus: other command limits");
  other = own;
  std::swap(other.muscles[9].limits.ecu, other.muscles[0].limits.ecu);
  EXPECT_EQ(difference(own, other), "lateral_deltoid: another ECU or channel");
  other = own;
  other.muscles.pop_back();
  EXPECT_EQ(difference(own, other), own.muscles.back().name + ": missing");
  EXPECT_EQ(difference(other, own), own.muscles.back().name + ": an additional muscle");
}

/// Anthrob's files with one text replaced, or two.
std::string error_of(const std::string& file, const std::string& from, const std::string& to,
                     const std::string& from_too = "", const std::string& to_too = "",
                     bool hand = true) {
  const fs::path folder =
      fs::temp_directory_path() / ("anthrob_hardware_" + std::to_string(getpid()));
  fs::create_directories(folder);
  for (const char* name : {"hardware.yaml", "sensors.yaml", "model_I.yaml", "model_II.yaml",
                           "model_II_hand.yaml", "hand.yaml"}) {
    std::ifstream in(kConfig / name);
    std::stringstream text;
    text << in.rdbuf();
    std::string content = text.str();
    if (name == file) {
      const auto at = content.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      content.replace(at, from.size(), to);
      if (!from_too.empty()) content.replace(content.find(from_too), from_too.size(), to_too);
    }
    std::ofstream(folder / name) << content;
  }
  std::string result = "no error";
  try {
    load_hardware(folder / "hardware.yaml", hand);
  } catch (const BadInput& error) {
    result = error.what();
  }
  fs::remove_all(folder);
  return result;
}

TEST(Hardware, BadFilesAreRefusedWithFileLineKey) {
  struct Case {
    const char *file, *from, *to, *expected;
    const char *from_too = "", *to_too = "";
  };
  const Case cases[] = {
      {"hardware.yaml", "model: model_II.yaml", "model: model_4.yaml",
       ": model: model_4.yaml: expected a file beside this one"},
      {"hardware.yaml", "calibration: sensors.yaml", "calibration: sensor.yaml",
       ": calibration: sensor.yaml: expected a file beside this one"},
      {"hardware.yaml", "ecu_1: {node: 1}", "ecu_1: {node: 0}", "ecus.ecu_1.node"},
      {"hardware.yaml", "ecu_2: {node: 2}", "ecu_2: {node: 1}", "another ECU has this node"},
      {"hardware.yaml", "current_limit: 16.0", "current_limit: 160.0",
       "units.type_1.current_limit"},
      {"hardware.yaml", "current_limit: 16.0", "curent_limit: 16.0", "current_limit"},
      {"hardware.yaml", "filter_order: 60", "filter_order: 61", "filter_order"},
      {"hardware.yaml", "position_range: [-30.0, 30.0]", "position_range: [30.0, -30.0]",
       "units.type_1.position_range: 30 to -30 rad"},
      {"hardware.yaml", "position_range: [-30.0, 30.0]", "position_range: [1.0, 30.0]",
       "units.type_1.position_range: 1 to 30 rad: expected a range with 0 in it"},
      {"hardware.yaml", "    voltage_limit: 6.0", "    voltage_limit: 6.0\n    period: 0.01",
       "hand.controller.period: 0.01: expected 0.001 s"},
      {"hardware.yaml", "    voltage_limit: 6.0", "    voltage_limit: 6.0\n    voltage_limt: 3.0",
       "hand.controller.voltage_limt: unknown key"},
      {"model_II.yaml", "extends:", "controllers: {type_1: {limits: {forse: 40}}}\nextends:",
       "controllers.type_1.limits.forse: unknown key"},
      {"model_II.yaml", "extends:", "controllers: {type_1: {period: 0.01}}\nextends:",
       "controllers.type_1.period: 0.01: expected 0.001 s"},
      {"model_II.yaml", "  brachialis:", "  brachialis:\n    gians: {}",
       "muscles.brachialis.gians: unknown key"},
      {"model_II.yaml", "extends:", "joints: {elbow: {drive: {actuator: type_1}}}\nextends:",
       "joints.elbow.drive: expected a model without drives"},
      {"hardware.yaml", "positions: {}", "positions: {brachialis: 31.0}",
       "home.positions.brachialis"},
      {"sensors.yaml", "gain: 0.01", "gain: 0.005", "units.type_1.current_limit: 16"},
      {"sensors.yaml", "gain: 0.06", "gain: 0.03",
       "the most that the sensor of lateral_deltoid can read"},
      // 221.4 N would be a count between the highest that is a force and the converter's last.
      {"hardware.yaml", "force_limit: 220.0", "force_limit: 221.4", "at most 221.22 N"},
      {"hardware.yaml", "force_limit: 20.0", "force_limit: 2.0", "home.force_limit"},
      {"hardware.yaml", "force_limit: 20.0", "force_limit: 151.0",
       "home.force_limit: 151.0: expected at most 150 N, force_limit of triceps_brachii"},
      {"hardware.yaml", "wind_speed: 1.0", "wind_speed: 6.1",
       "home.wind_speed: 6.1: expected at most 6 rad/s, half of speed_limit of lateral_deltoid"},
      {"hardware.yaml", "travel_limit: 6.0", "travel_limit: 61",
       "home.travel_limit: 61: expected less than 20 rad, wind_speed x time_limit"},
      {"hardware.yaml", "position_rate: 50.0", "position_rate: 0.25",
       "home.travel_limit: 6.0: expected less than 5 rad, position_rate of lateral_deltoid x time"},
      {"hardware.yaml", "settle_time: 1.0", "settle_time: 20", "expected less than time_limit"},
      {"hardware.yaml", "travel_limit: 6.0", "travel_limit: 19",
       "home.travel_limit: 19: expected at most 10 rad, the end of position_range of lateral",
       "position_range: [-30.0, 30.0]", "position_range: [-30.0, 10.0]"},
      {"hardware.yaml", "time_limit: 20.0", "time_limit: 1e5", "expected at most 120 s"},
      {"hardware.yaml", "tolerance: 1.0", "tolerance: 2.5", "home.tolerance"},
      {"hardware.yaml", "slip_drop: 0.5", "slip_drop: 0.2", "home.slip_drop"},
      {"hardware.yaml", "slip_drop: 0.5", "slip_drop: 1.0", "home.slip_drop: 1.0: expected less"},
      {"hardware.yaml", "hand_agonist: {ecu: ecu_7}", "hand_agonist: {ecu: ecu_9}", "ecu_9"},
      {"hardware.yaml", "hand_agonist: {ecu: ecu_7}", "hand_agonist: {ecu: ecu_1}",
       "already has 2"},
      {"hardware.yaml", "metacarpal_1: {ecu: ecu_7, input: 1}",
       "metacarpal_1: {ecu: ecu_7, input: 0}",
       "hand.touch.metacarpal_1.input: 0 of ecu_7: already used by ring_finger_tip"},
      {"hardware.yaml", "elbow: {ecu: ecu_6, input: 0}", "elbow: {ecu: ecu_7, input: 3}",
       "joints.elbow.input: 3 of ecu_7: already used by metacarpal_3"},
      {"hardware.yaml", "pretension: 5.0", "pretension: -5.0", "home.pretension"},
      {"hardware.yaml", "loaded: 20.0", "loaded: 2.0", "loaded: 2 N: expected 0, or more than"},
      {"sensors.yaml", "gain: 0.06", "gain: -0.06", "lateral_deltoid.force.gain"},
      {"sensors.yaml", "offset: 400", "offset: 5000", "offset"},
      {"sensors.yaml", "gain: 0.06, offset: 400", "gain: 0.06, offset: 4090",
       "lateral_deltoid.force.offset: 4090: expected a number in [0, 4087]"},
      {"model_I.yaml", "    ecu: ecu_1\n", "",
       "muscles.lateral_deltoid: expected keys 'controller' and 'ecu': its sensors are in"},
      {"sensors.yaml", "threshold: 20", "threshold: nan", "threshold"},
      {"sensors.yaml", "elbow:", "knee:", "elbow"},
  };
  for (const Case& c : cases) {
    const std::string error = error_of(c.file, c.from, c.to, c.from_too, c.to_too);
    EXPECT_NE(error.find(c.expected), std::string::npos) << c.to << " gave: " << error;
    EXPECT_NE(error.find(".yaml:"), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST(Hardware, TheAngleOfAJointMayBeZeroOutOfItsSensorsRange) {
  const std::string sensor = "elbow: {gain: 1.2783173232380343e-3, offset: ";
  EXPECT_EQ(error_of("sensors.yaml", sensor + "400", sensor + "-100"), "no error");
}

TEST(Hardware, AHandsEcusAreThoseOfTheModelThatHasTheHand) {
  const std::string error =
      error_of("hardware.yaml", "model: model_II.yaml", "model: model_II_hand.yaml",
               "hand_agonist: {ecu: ecu_7}", "hand_agonist: {ecu: ecu_6}");
  EXPECT_NE(error.find("hand.muscles.hand_agonist.ecu: ecu_6: expected ecu_7, as in"),
            std::string::npos)
      << error;
}

TEST(Hardware, OneFileNamesZerosWithAndWithoutTheHand) {
  const auto load = [](bool hand) {
    return error_of("hardware.yaml", "positions: {}", "positions: {hand_agonist: 1.0}", "", "",
                    hand);
  };
  EXPECT_EQ(load(true), "no error");
  EXPECT_EQ(load(false), "no error");
}

TEST(Hardware, HomeMayAskWhatEveryUnitStands) {
  EXPECT_EQ(error_of("hardware.yaml", "wind_speed: 1.0", "wind_speed: 6.0", "travel_limit: 6.0",
                     "travel_limit: 30.0"),
            "no error");
  EXPECT_EQ(error_of("hardware.yaml", "force_limit: 20.0", "force_limit: 150.0", "time_limit: 20.0",
                     "time_limit: 120.0"),
            "no error");
}

TEST(Hardware, ASensorOnAUnitThatIsNotListenedToIsRefused) {
  EXPECT_EQ(error_of("hardware.yaml", "ecu_7: {node: 7}", "ecu_7: {node: 7}\n  ecu_8: {node: 8}"),
            "no error");
  const std::string error =
      error_of("hardware.yaml", "ecu_7: {node: 7}", "ecu_7: {node: 7}\n  ecu_8: {node: 8}",
               "ecu_6, input: 0", "ecu_8, input: 0");
  EXPECT_NE(error.find("hardware.yaml:"), std::string::npos) << error;
  EXPECT_NE(error.find("joints.elbow.ecu: ecu_8: expected an ECU with muscles; this one has none"),
            std::string::npos)
      << error;
}

TEST(Calibration, CountsAndValuesAreInverse) {
  const LinearSensor gauge{0.06, 400.0};
  for (const double force : {0.0, 5.0, 123.4, 221.0}) {
    EXPECT_NEAR(gauge.value(gauge.count(force)), force, 0.031);
  }
  const ForceSensitiveResistor pad{5.0, 20.0};
  for (const double force : {0.0, 0.5, 5.0, 50.0}) {
    EXPECT_NEAR(pad.force(pad.count(force)), force, 0.01 * force + 0.01);
  }
  EXPECT_EQ(pad.force(19), 0.0);
  // A short circuit is no touch, however strong.
  EXPECT_TRUE(std::isfinite(pad.force(ecu::kHighestCount)));
  EXPECT_TRUE(std::isnan(pad.force(ecu::kHighestCount + 1)));
  EXPECT_TRUE(std::isnan(pad.force(4095)));
  EXPECT_EQ(pad.count(1e9), 4095);
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
