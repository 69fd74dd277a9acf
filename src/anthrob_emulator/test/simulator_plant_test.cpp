// The simulator behind emulated ECUs: what their sensors and power stages are wired to.
#include "simulator_plant.h"

#include <gtest/gtest.h>

#include "emulated_robot.h"

namespace anthrob {
namespace {

using testing_support::kHardware;

SimulatorPlant plant_with(const driver::Hardware& hardware,
                          const std::vector<EffectInstance>& effects) {
  LoadOptions options;
  options.effects = effects;
  return SimulatorPlant(load_robot_model(ANTHROB_CONFIG_DIR "/anthrob/model_II.yaml", options),
                        hardware);
}

TEST(SimulatorPlant, BoardsReadWhatEffectsOfSensorsLetThemRead) {
  const driver::Hardware hardware = driver::load_hardware(kHardware, false);
  SimulatorPlant plain = plant_with(hardware, {});
  SimulatorPlant wrong = plant_with(hardware, {{"encoder_drift", "all", {{"rate", 0.05}}},
                                               {"force_sensor_offset", "all", {{"offset", 3.0}}}});
  constexpr int kSteps = 500;
  for (int i = 0; i < kSteps; ++i) plain.advance(), wrong.advance();
  for (std::size_t m = 0; m < hardware.muscles.size(); ++m) {
    const driver::Plant::Muscle truth = plain.muscle(m), read = wrong.muscle(m);
    EXPECT_NEAR(read.position - truth.position, 0.05 * 1e-3 * kSteps, 1e-9) << m;
    EXPECT_NEAR(read.force - truth.force, 3.0, 1e-9) << m;
    EXPECT_EQ(read.current, truth.current) << m;
  }
}

TEST(SimulatorPlant, AModelOfAnotherRobotIsRefused) {
  const driver::Hardware hardware = driver::load_hardware(kHardware, false);
  try {
    SimulatorPlant(load_robot_model(ANTHROB_CONFIG_DIR "/two_muscle_rig/model_I.yaml"), hardware);
    FAIL() << "accepted";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("model_I.yaml: muscles: lateral_deltoid of "),
              std::string::npos)
        << error.what();
  }
}

TEST(SimulatorPlant, CommandsThatTheSimulatorDelaysAreRefused) {
  const driver::Hardware hardware = driver::load_hardware(kHardware, false);
  try {
    plant_with(hardware, {{"command_latency", "brachialis", {{"delay", 0.01}}}});
    FAIL() << "accepted";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("command_latency of muscle brachialis"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace anthrob
