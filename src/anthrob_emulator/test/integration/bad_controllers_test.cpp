// Simulator and driver read the controllers of a model file: what one refuses, the other refuses
// with the same message.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "anthrob_core/errors.h"
#include "anthrob_driver/hardware.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {
namespace {

namespace fs = std::filesystem;

const fs::path kRig = ANTHROB_CONFIG_DIR "/two_muscle_rig";

struct Messages {
  std::string simulator = "no error", driver = "no error";
};

/// @param changes what a file changes of the rig's model
Messages load(const std::string& changes) {
  const fs::path file =
      fs::temp_directory_path() / ("anthrob_bad_controllers_" + std::to_string(getpid()) + ".yaml");
  std::ofstream(file) << "extends: " << (kRig / "model_I.yaml").string() << "\n" << changes << "\n";
  Messages messages;
  try {
    load_robot_model(file.string());
  } catch (const BadInput& error) {
    messages.simulator = error.what();
  }
  try {
    driver::load_hardware((kRig / "hardware.yaml").string(), false, file.string());
  } catch (const BadInput& error) {
    messages.driver = error.what();
  }
  fs::remove(file);
  return messages;
}

TEST(BadControllers, SimulatorAndDriverRefuseThemAlike) {
  struct Case {
    const char *changes, *expected;
  };
  const Case cases[] = {
      {"controllers: {pd: {period: null}}", "controllers.pd: key 'period' is missing"},
      {"controllers: {pd: {period: 0}}", "controllers.pd.period: 0: expected a number > 0 [s]"},
      {"controllers: {pd: {voltage_limit: 0}}", "controllers.pd.voltage_limit: 0: expected"},
      {"controllers: {pd: {position: {proportional: -1}}}",
       "controllers.pd.position.proportional: -1: expected a number in [0, 1000] [V/rad]"},
      {"controllers: {pd: {position: {proportional: 1001}}}",
       "controllers.pd.position.proportional: 1001: expected a number in [0, 1000] [V/rad]"},
      {"controllers: {pd: {position: {force_feedforward: -0.1}}}",
       "controllers.pd.position.force_feedforward: -0.1: expected a number in [0, 10] [V/N]"},
      {"controllers: {pd: {force: {force_feedforward: 11}}}",
       "controllers.pd.force.force_feedforward: 11: expected a number in [0, 10] [V/N]"},
      {"controllers: {pd: {current: {integral: .nan}}}", "controllers.pd.current.integral: .nan"},
      {"controllers: {pd: {current: {integral: null}}}", "key 'integral' is missing"},
      {"controllers: {pd: {force: 1}}", "controllers.pd.force: 1: expected a map"},
      {"controllers: {pd: {limits: {position: 0}}}", "controllers.pd.limits.position: 0"},
      {"controllers: {pd: {limits: {force: -1}}}", "controllers.pd.limits.force: -1"},
      {"controllers: {pd: {limits: {forse: 40}}}", "controllers.pd.limits.forse: unknown key"},
      {"muscles: {flexor: {controller: dp}}",
       "muscles.flexor.controller: dp: expected the name of an entry of 'controllers'"},
      {"muscles: {flexor: {gains: {K_P: 7}}}", "muscles.flexor.gains.K_P: unknown gain"},
      {"muscles: {flexor: {gains: {voltage_limit: 7}}}", "gains.voltage_limit: unknown gain"},
      {"muscles: {flexor: {gains: {force_integral: 1001}}}",
       "muscles.flexor.gains.force_integral: 1001: expected a number in [0, 1000] [V/(Ns)]"},
      {"muscles: {flexor: {controller: null, gains: {force_integral: 1}}}",
       "muscles.flexor.gains: only a muscle with a controller has gains"},
      {"muscles: {flexor: {gians: {}}}", "muscles.flexor.gians: unknown key"},
  };
  for (const Case& c : cases) {
    const Messages messages = load(c.changes);
    EXPECT_NE(messages.simulator.find(c.expected), std::string::npos)
        << c.changes << " gave: " << messages.simulator;
    EXPECT_EQ(messages.simulator, messages.driver) << c.changes;
  }
}

TEST(BadControllers, OnlyTheDriverKnowsTheUnitsOwnLimits) {
  const Messages volts = load("controllers: {pd: {voltage_limit: 48}}");
  EXPECT_EQ(volts.simulator, "no error");
  EXPECT_NE(volts.driver.find("controllers.pd.voltage_limit: 48: expected voltage_limit in the "
                              "range of the ECU, 0 to 20 V"),
            std::string::npos)
      << volts.driver;
  const Messages period = load("controllers: {pd: {period: 0.002}}");
  EXPECT_EQ(period.simulator, "no error");
  EXPECT_NE(period.driver.find("controllers.pd.period: 0.002: expected 0.001 s"), std::string::npos)
      << period.driver;
}

}  // namespace
}  // namespace anthrob
