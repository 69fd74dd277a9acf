// The same commands to the simulator with the sensors of the units (model_II_ecu) and to driver +
// bus + seven emulated ECUs, in lock-step: the motions must agree, not only where they end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "emulated_robot.h"

namespace anthrob {
namespace {

const char* const kIdeal = ANTHROB_CONFIG_DIR "/anthrob/model_II.yaml";
const char* const kAsUnits = ANTHROB_CONFIG_DIR "/anthrob/model_II_ecu.yaml";
constexpr double kPotentiometerCount = 1.2783173232380343e-3;  // [rad]
constexpr double kPeriod = 2.0;                                // [s]
constexpr int kLength = 4000;                                  // [ms]

using testing_support::EmulatedRobot;
using testing_support::kHardware;
using testing_support::kReach;
using testing_support::References;

// [N]
const References kPull = {
    {"lateral_deltoid", 40.0}, {"anterior_deltoid", 20.0}, {"posterior_deltoid", 10.0},
    {"supraspinatus", 20.0},   {"infraspinatus", 6.0},     {"teres_minor", 6.0},
    {"teres_major", 6.0},      {"pectoralis_major", 6.0},  {"biceps_brachii", 14.0},
    {"triceps_brachii", 10.0}, {"brachialis", 10.0},
};

/// To the peak and back, with no step in the speed.
References wave(References peak, int ms) {
  for (auto& [name, value] : peak) value *= 0.5 * (1.0 - std::cos(2e-3 * M_PI * ms / kPeriod));
  return peak;
}

/// The furthest that simulator and robot are from each other.
struct Apart {
  double position = 0.0, velocity = 0.0, current = 0.0, force = 0.0;  ///< as measured
  double elbow_reading = 0.0, elbow = 0.0, shoulder = 0.0;            ///< [rad]
  double most_elbow = 0.0;  ///< [rad] how far the robot's bent

  void see(const ecu::Measurement& simulated, const driver::MuscleSample& unit) {
    EXPECT_TRUE(unit.measured);
    EXPECT_EQ(unit.state, ecu::State::kEnabled);
    grow(position, simulated.position, unit.position);
    grow(velocity, simulated.velocity, unit.velocity);
    grow(current, simulated.current, unit.current);
    grow(force, simulated.force, unit.force);
  }
  void see_truth(const std::vector<double>& p, const std::vector<double>& q) {
    grow(elbow, p[4], q[4]);
    shoulder = std::max(
        shoulder, angular_distance(Quat(p[0], p[1], p[2], p[3]), Quat(q[0], q[1], q[2], q[3])));
    most_elbow = std::max(most_elbow, q[4]);
  }
  static void grow(double& worst, double a, double b) { worst = std::max(worst, std::abs(a - b)); }
};

Apart compare(const char* model, ecu::Mode mode, const References& peak) {
  EmulatedRobot robot(kIdeal, kHardware);
  Simulation sim(load_robot_model(model));
  const int elbow = sim.model().skeleton->find_joint("elbow");
  robot.enable();
  sim.step(robot.milliseconds());
  Apart apart;
  for (int ms = 0; ms < kLength; ms += EmulatedRobot::kCycle) {
    const References references = wave(peak, ms);
    robot.command(references, mode);
    for (const auto& [name, value] : references) {
      sim.command(sim.model().find_muscle(name), mode, value);
    }
    // The units answer with what they measure now.
    std::vector<ecu::Measurement> simulated;
    for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
      simulated.push_back(sim.muscle(static_cast<int>(m)).measured());
    }
    const double asked = 0.001 * robot.milliseconds();
    const double elbow_reading = sim.measured_joint_position(elbow);
    apart.see_truth(sim.configuration(), robot.truth().configuration());
    for (int k = 0; k < EmulatedRobot::kCycle; ++k) robot.step();
    sim.step(EmulatedRobot::kCycle);
    EXPECT_EQ(robot.last().time, asked);
    for (std::size_t m = 0; m < simulated.size(); ++m) {
      apart.see(simulated[m], robot.last().muscles[m]);
    }
    if (robot.last_analog().time != asked) continue;
    Apart::grow(apart.elbow_reading, elbow_reading, robot.last_analog().value);
  }
  std::printf(
      "apart by at most %.1e rad, %.3f rad/s, %.3f A, %.3f N; elbow %.1e rad (read: %.1e), "
      "shoulder %.1e rad; the elbow bent by %.2f rad\n",
      apart.position, apart.velocity, apart.current, apart.force, apart.elbow, apart.elbow_reading,
      apart.shoulder, apart.most_elbow);
  return apart;
}

void expect_close(const Apart& apart) {
  EXPECT_LE(apart.position, 4e-3);                             // [rad] of the motor
  EXPECT_LE(apart.velocity, 0.06);                             // [rad/s] five counts in 8 ms
  EXPECT_LE(apart.current, 0.04);                              // [A] four counts
  EXPECT_LE(apart.force, 0.12);                                // [N] two counts
  EXPECT_LE(apart.elbow, 1e-3);                                // [rad]
  EXPECT_LE(apart.elbow_reading, 1.01 * kPotentiometerCount);  // one falls to the other side
  EXPECT_LE(apart.shoulder, 1e-3);                             // [rad]
  EXPECT_GT(apart.most_elbow, 0.2);                            // it did move
}

TEST(LockStepMotion, PositionCommandsMoveBothAlike) {
  expect_close(compare(kAsUnits, ecu::Mode::kPosition, kReach));
}

TEST(LockStepMotion, ForceCommandsMoveBothAlike) {
  expect_close(compare(kAsUnits, ecu::Mode::kForce, kPull));
}

/// What the filter of the force does: 30 ms, of which a controller of one's own must know.
TEST(LockStepMotion, IdealSensorsShowAnotherForce) {
  EXPECT_GT(compare(kIdeal, ecu::Mode::kPosition, kReach).force, 2.0);  // [N]
  const Apart pulled = compare(kIdeal, ecu::Mode::kForce, kPull);
  EXPECT_GT(pulled.force, 2.0);      // [N]
  EXPECT_GT(pulled.position, 0.05);  // [rad] the control loops differ by it, too
}

TEST(LockStepMotion, CountsOfTheModelAreThoseOfTheHardware) {
  const auto model = load_robot_model(kAsUnits);
  const driver::Hardware hardware = driver::load_hardware(kHardware, false);
  for (const driver::MuscleHardware& muscle : hardware.muscles) {
    EXPECT_FLOAT_EQ(model->sensors.position.quantum, muscle.encoder_scale) << muscle.name;
    EXPECT_EQ(model->sensors.current.quantum, muscle.current.gain) << muscle.name;
    EXPECT_EQ(model->sensors.force.quantum, muscle.force.gain) << muscle.name;
    EXPECT_EQ(model->sensors.force.average,
              1 + std::lround(muscle.parameters.get(ecu::Parameter::kFilterOrder)))
        << muscle.name;
  }
  ASSERT_EQ(hardware.joints.size(), 1u);
  EXPECT_EQ(model->sensors.joint_position.quantum, hardware.joints[0].sensor.gain);
}

}  // namespace
}  // namespace anthrob
