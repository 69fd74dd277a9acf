// The same commands to the simulator and to driver + bus + seven emulated ECUs on the same physics,
// in lock-step: the equilibria must agree within one count of each sensor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "emulated_robot.h"

namespace anthrob {
namespace {

const char* const kModel = ANTHROB_CONFIG_DIR "/anthrob/model_II.yaml";
const char* const kHandModel = ANTHROB_CONFIG_DIR "/anthrob/model_II_hand.yaml";

using testing_support::EmulatedRobot;
using testing_support::kHardware;
using testing_support::kReach;
using testing_support::References;

/// What both ends say at the end.
struct Outcome {
  std::vector<double> position, force, volts;
  std::vector<double> q;
};

Outcome simulate(const References& references, int milliseconds) {
  Simulation sim(load_robot_model(kModel));
  for (const auto& [name, value] : references) {
    sim.command(sim.model().find_muscle(name), ecu::Mode::kPosition, value);
  }
  sim.step(milliseconds);
  Outcome outcome;
  for (std::size_t i = 0; i < sim.muscle_count(); ++i) {
    const ecu::Measurement& measured = sim.muscle(static_cast<int>(i)).measured();
    outcome.position.push_back(measured.position);
    outcome.force.push_back(measured.force);
    outcome.volts.push_back(sim.muscle(static_cast<int>(i)).voltage());
  }
  outcome.q = sim.configuration();
  return outcome;
}

Outcome emulate(const References& references, int milliseconds) {
  EmulatedRobot robot(kModel, kHardware);
  robot.enable();
  for (int ms = 0; ms < milliseconds; ++ms) {
    if (ms % 100 == 0) robot.command(references, ecu::Mode::kPosition);
    robot.step();
  }
  Outcome outcome;
  for (const driver::MuscleSample& muscle : robot.last().muscles) {
    EXPECT_EQ(muscle.state, ecu::State::kEnabled);
    outcome.position.push_back(muscle.position);
    outcome.force.push_back(muscle.force);
    outcome.volts.push_back(muscle.voltage);
  }
  outcome.q = robot.truth().configuration();
  return outcome;
}

TEST(LockStep, EquilibriaAgreeWithinOneCount) {
  constexpr int kSettle = 60000;  // [ms] tendons creep through their eyelets for that long
  const Outcome sim = simulate(kReach, kSettle), robot = emulate(kReach, kSettle);
  ASSERT_EQ(sim.position.size(), 11u);
  ASSERT_EQ(robot.position.size(), 11u);
  constexpr double kEncoderCount = 9.587379924285257e-5, kForceCount = 0.06;
  double worst_position = 0.0, worst_force = 0.0;
  for (std::size_t m = 0; m < 11; ++m) {
    const double apart = std::abs(robot.position[m] - sim.position[m]);
    EXPECT_LT(apart, 2.0 * kEncoderCount) << m;
    worst_position = std::max(worst_position, apart);
    EXPECT_LE(std::abs(std::lround(robot.position[m] / kEncoderCount) -
                       std::lround(sim.position[m] / kEncoderCount)),
              1)
        << m;
    const double pull = std::abs(robot.force[m] - sim.force[m]);
    EXPECT_LE(pull, kForceCount) << m;
    worst_force = std::max(worst_force, pull);
  }
  const Quat a(sim.q[0], sim.q[1], sim.q[2], sim.q[3]),
      b(robot.q[0], robot.q[1], robot.q[2], robot.q[3]);
  RecordProperty("worst_position_urad", static_cast<int>(1e6 * worst_position));
  RecordProperty("worst_force_mN", static_cast<int>(1e3 * worst_force));
  std::printf(
      "positions differ by %.1e rad, forces by %.4f N, shoulder by %.1e rad, elbow by %.1e rad\n",
      worst_position, worst_force, angular_distance(a, b), std::abs(sim.q[4] - robot.q[4]));
  EXPECT_LE(angular_distance(a, b), 1e-3);
  EXPECT_LE(std::abs(sim.q[4] - robot.q[4]), 1.28e-3);  // one count of the potentiometer
  // The arm did move.
  EXPECT_LT(std::abs(a.w()), 0.999);
}

TEST(Hand, PadsOfTheRobotFeelWhatThoseOfTheModelFeel) {
  const driver::Hardware hardware = driver::load_hardware(kHardware, true);
  SimulatorPlant plant(load_robot_model(kHandModel), hardware);
  const auto& pads = plant.simulation().model().touch_pads;
  ASSERT_EQ(hardware.touch.size(), pads.size());
  for (std::size_t m = 0; m < hardware.muscles.size(); ++m) {
    if (hardware.muscles[m].name == "hand_agonist") plant.drive(m, 6.0);
    if (hardware.muscles[m].name == "hand_antagonist") plant.drive(m, -3.0);
  }
  for (int k = 0; k < 3000; ++k) plant.advance();
  for (std::size_t t = 0; t < hardware.touch.size(); ++t) {
    const auto pad = std::find_if(pads.begin(), pads.end(), [&](const TouchPadModel& p) {
      return p.name == hardware.touch[t].name;
    });
    ASSERT_NE(pad, pads.end()) << hardware.touch[t].name;
    const Simulation& sim = plant.simulation();
    EXPECT_EQ(plant.touch(t), pad_force(*pad, sim.tree(), sim.configuration()));
    EXPECT_GT(plant.touch(t), 0.0);  // the hand is closed
  }
}

}  // namespace
}  // namespace anthrob
