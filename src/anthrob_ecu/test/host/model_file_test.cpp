#include "anthrob_ecu/model_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "anthrob_core/errors.h"
#include "anthrob_ecu/parameters.h"

namespace anthrob {
namespace ecu {
namespace {

const char* const kController =
    "period: 0.002\n"
    "voltage_limit: 12\n"
    "limits: {position: 30, current: 7, force: 0}\n"
    "position: {proportional: 1, derivative: 2, force_feedforward: 3}\n"
    "current: {proportional: 4, integral: 5}\n"
    "force: {proportional: 6, integral: 7, derivative: 8, force_feedforward: 9}\n";

/// kController with one text replaced.
ConfigNode controller(const std::string& from = "", const std::string& to = "") {
  std::string text = kController;
  text.replace(text.find(from), from.size(), to);
  return ConfigNode::parse(text, "m.yaml");
}

std::string error_of(const ConfigNode& node) {
  try {
    read_controller(node);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "no error";
}

TEST(ModelFile, EveryGainHasItsPlace) {
  const ConfigNode node = controller();
  ControllerKind kind = read_controller(node);
  double next = 1.0;
  for (const ParameterInfo& gain : kParameters) {
    if (!gain.live) continue;
    EXPECT_EQ(*gain_of(kind.settings, gain.parameter), next++) << gain.name;
  }
  EXPECT_EQ(kind.settings.period, 0.002);
  EXPECT_EQ(kind.settings.voltage_limit, 12.0);
  EXPECT_EQ(kind.largest_position, 30.0);
  EXPECT_EQ(kind.largest_current, 7.0);
  EXPECT_EQ(kind.largest_force, 0.0);
  node.refuse_unknown_keys();
}

TEST(ModelFile, APeriodMayBeGivenBesideTheFile) {
  const std::string without = "period: 0.002\n";
  EXPECT_EQ(read_controller(controller(without, ""), 0.001).settings.period, 0.001);
  EXPECT_EQ(read_controller(controller(), 0.001).settings.period, 0.002);
  EXPECT_NE(error_of(controller(without, "")).find("period"), std::string::npos);
}

TEST(ModelFile, GainsAreThoseThatAUnitAccepts) {
  // 48 V is more than a unit has, but may be simulated.
  EXPECT_EQ(error_of(controller("voltage_limit: 12", "voltage_limit: 48")), "no error");
  EXPECT_EQ(error_of(controller("voltage_limit: 12", "voltage_limit: 0")),
            "m.yaml:2: voltage_limit: 0: expected a number > 0 [V]");
  EXPECT_EQ(error_of(controller("force_feedforward: 3", "force_feedforward: -3")),
            "m.yaml:4: position.force_feedforward: -3: expected a number in [0, 10] [V/N]");
  EXPECT_EQ(error_of(controller("integral: 5", "integral: 1e6")),
            "m.yaml:5: current.integral: 1e6: expected a number in [0, 100000] [V/(As)]");
}

TEST(ModelFile, GainsOfAMuscleOverrideItsKinds) {
  ControllerSettings settings = read_controller(controller()).settings;
  read_gains(ConfigNode::parse("gains: {force_integral: 0.5}", "m.yaml"), settings);
  read_gains(ConfigNode::parse("ecu: ecu_1", "m.yaml"), settings);
  EXPECT_EQ(settings.force.integral, 0.5);
  EXPECT_EQ(settings.force.derivative, 8.0);
}

TEST(ModelFile, CheckingAMuscleReadsNothing) {
  const ConfigNode muscle = ConfigNode::parse("controller: pd\nspring: {kind: ring}", "m.yaml");
  check_muscle(muscle);
  EXPECT_THROW(muscle.refuse_unknown_keys(), BadInput);
  EXPECT_THROW(check_muscle(ConfigNode::parse("controler: pd", "m.yaml")), BadInput);
  EXPECT_THROW(check_muscle(ConfigNode::parse("gains: {force_integral: 1}", "m.yaml")), BadInput);
}

TEST(ModelFile, EveryShippedControllerIsWithinTheBounds) {
  int controllers = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(ANTHROB_CONFIG_DIR)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("model_", 0) != 0 || entry.path().extension() != ".yaml") continue;
    const ConfigNode model = ConfigNode::load(entry.path().string());
    if (!model.has("controllers")) continue;
    for (const auto& [kind, node] : model.at("controllers").entries()) {
      EXPECT_EQ(error_of(node), "no error") << kind;
      ++controllers;
    }
  }
  EXPECT_GT(controllers, 10);
}

}  // namespace
}  // namespace ecu
}  // namespace anthrob
