// The controller on the simulated arm, in lock-step and without ROS.
#include "anthrob_control/computed_force.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>

#include "anthrob_sim/statics/equilibrium.h"
#include "closed_loop.h"

namespace anthrob {
namespace {

using testing_support::ClosedLoop;
using testing_support::JointNoise;

constexpr double kDegree = M_PI / 180.0;
const std::string kAnthrob = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/";
/// Larger than what a stereo rig a metre away shows of a humerus (0.1 degrees).
const JointNoise kNoise{0.2 * kDegree, 0.05};

/// A model file that extends one of Anthrob's.
std::shared_ptr<const RobotModel> extended(const std::string& base, const std::string& text) {
  const std::string file = "/tmp/anthrob_control_" + std::to_string(getpid()) + ".yaml";
  std::ofstream(file) << "extends: " << kAnthrob << base << "\nrobot: " << kAnthrob
                      << "robot.urdf\n"
                      << text;
  auto model = load_robot_model(file);
  std::remove(file.c_str());
  return model;
}

std::shared_ptr<const RobotModel> with_noisy_sensors(const std::string& base) {
  return extended(base,
                  "sensors:\n  seed: 7\n  force: {noise: 0.3, quantum: 0.122}\n"
                  "  position: {quantum: 0.0061}\n  velocity: {noise: 0.05}\n"
                  "  current: {noise: 0.02}\n  joint_position: {noise: 0.004}\n");
}

/// Postures that the muscles can hold with half their strength, anywhere in the arm's range.
std::vector<std::vector<double>> reachable_postures(const std::shared_ptr<const RobotModel>& model,
                                                    int count) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Simulation scratch(model);
  std::vector<std::vector<double>> postures;
  while (static_cast<int>(postures.size()) < count) {
    const Vec3 axis(normal(random), normal(random), normal(random));
    const Quat turn = quaternion_of(axis.normalized() * share(random) * 0.9);
    const std::vector<double> q{turn.w(), turn.x(), turn.y(), turn.z(), 0.05 + 2.0 * share(random)};
    const Equilibrium e = find_equilibrium(scratch, q, {2.0, 80.0});
    if (e.shortfall.norm() > 1e-3) continue;
    if (*std::max_element(e.tension.begin(), e.tension.end()) < 50.0) postures.push_back(q);
  }
  return postures;
}

/// Largest motion of any joint within 10 s of zero gravity.
double drift(ClosedLoop& loop, const std::vector<double>& q) {
  loop.place(q);
  double most = 0.0;
  for (int i = 0; i < 50; ++i) {
    loop.run(0.2);
    for (const int joint : {0, 1}) {
      const double moved = loop.distance(q, joint);
      if (moved > most || std::isnan(moved)) most = moved;  // NaN stays
    }
  }
  return most;
}

TEST(ComputedForce, ZeroGravityHoldsReachablePosturesUnderSensorNoise) {
  for (const char* name : {"I", "II"}) {
    const auto plant = with_noisy_sensors("model_" + std::string(name) + ".yaml");
    const auto settings = ControlSettings::load(kAnthrob + "control.yaml", *plant);
    double worst = 0.0;
    std::uint64_t seed = 0;
    for (const auto& q : reachable_postures(plant, 12)) {
      ClosedLoop loop(plant, plant, settings, kNoise, ++seed);
      const double moved = drift(loop, q);
      EXPECT_LT(moved, 2.0 * kDegree) << name << " posture " << seed;
      EXPECT_LT(loop.command->shortfall.norm(), 1e-3);
      worst = std::max(worst, moved);
    }
    std::printf("model %s: largest drift in 10 s %.2f deg\n", name, worst / kDegree);
  }
}

TEST(ComputedForce, EveryOutputHoldsThePosture) {
  const auto plant = with_noisy_sensors("model_II.yaml");
  auto settings = ControlSettings::load(kAnthrob + "control.yaml", *plant);
  for (const ecu::Mode mode : {ecu::Mode::kPosition, ecu::Mode::kVoltage}) {
    settings.hold_output = mode;
    for (const auto& q : reachable_postures(plant, 3)) {
      ClosedLoop loop(plant, plant, settings, kNoise);
      EXPECT_LT(drift(loop, q), 2.0 * kDegree) << static_cast<int>(mode);
    }
  }
}

/// A ligament beside teres minor, slack up to `length`.
std::shared_ptr<const RobotModel> with_ligament(double length) {
  return extended("model_I.yaml",
                  "springs: {band: {type: spring_damper, rest_length: 0.02, stiffness: 2000, "
                  "damping: 5}}\nactuators: {ligament: {type: ligament}}\n"
                  "muscles:\n  capsule:\n    actuator: ligament\n    rest_tendon_length: " +
                      std::to_string(length - 0.02) +
                      "\n    spring: {kind: band, segment: 0}\n    force_sensor_segment: 0\n"
                      "    path:\n"
                      "      - {point: [-0.0402, -0.1710, 0.3485], body: base}\n"
                      "      - {point: [-0.0091, 0.1702, -0.0147], body: humerus}\n");
}

TEST(ComputedForce, MusclesHoldWhatALigamentPulls) {
  const double at_rest = Simulation(with_ligament(0.05)).muscle(11).length();
  const auto plant = with_ligament(at_rest - 0.006);
  const auto settings = ControlSettings::load(kAnthrob + "control.yaml", *plant);
  ClosedLoop loop(plant, plant, settings);
  const std::vector<double> q{1.0, 0.0, 0.0, 0.0, 0.2};
  EXPECT_LT(drift(loop, q), 0.5 * kDegree);
  const ForceCommand& command = *loop.command;
  EXPECT_GT(command.tension[11], 5.0);
  EXPECT_NEAR(command.tension[11], loop.sim.muscle(11).force(), 0.1);
  EXPECT_NEAR((moment_arm_matrix(loop.sim) * command.tension - command.torque).norm(), 0.0, 1e-3);
}

TEST(ComputedForce, CarriesWhatEffectsPutOnTheJoints) {
  const auto plant = extended("model_II.yaml",
                              "effects:\n  - {id: cable_drag, place: shoulder, stiffness: 0.8}\n"
                              "  - {id: joint_offset_torque, place: elbow, torque: 0.3}\n");
  for (const auto& q : reachable_postures(plant, 3)) {
    Simulation sim(plant);
    sim.place(q, std::vector<double>(11, 0.0));
    PostureModel posture(plant);
    posture.update(q, Eigen::VectorXd::Zero(4));
    EXPECT_NEAR((posture.load() - holding_load(sim)).norm(), 0.0, 1e-9);
  }
}

TEST(ComputedForce, ForcesAreTheLeastEffortOnesAndTheMusclesDeliverThem) {
  const auto plant = load_robot_model(kAnthrob + "model_II.yaml");
  const auto settings = ControlSettings::load(kAnthrob + "control.yaml", *plant);
  for (const auto& q : reachable_postures(plant, 6)) {
    ClosedLoop loop(plant, plant, settings);
    loop.place(q);
    loop.run(5.0);
    const Eigen::VectorXd lowest = Eigen::VectorXd::Constant(11, settings.lowest_tension),
                          highest = Eigen::VectorXd::Constant(11, settings.highest_tension);
    // The independent solver, on moment arms that the simulation computes itself.
    const LeastEffort reference =
        least_effort(moment_arm_matrix(loop.sim), loop.command->torque, lowest, highest);
    for (int m = 0; m < 11; ++m) {
      EXPECT_NEAR(loop.command->tension[m], reference.tension[m], 0.05) << m;
      EXPECT_NEAR(loop.sim.muscle(m).force(), loop.command->tension[m], 0.5) << m;
    }
    EXPECT_LT((loop.command->torque - holding_load(loop.sim)).norm(), 0.02);
  }
}

TEST(ComputedForce, GoesToAPostureAndStays) {
  const auto plant = with_noisy_sensors("model_II.yaml");
  const auto settings = ControlSettings::load(kAnthrob + "control.yaml", *plant);
  const auto postures = reachable_postures(plant, 4);
  ClosedLoop loop(plant, plant, settings, kNoise);
  loop.place(plant->skeleton->rest_configuration());
  loop.run(0.5);
  for (const auto& q : postures) {
    loop.controller.go_to(q, 2.0);
    EXPECT_FALSE(loop.controller.holds());
    loop.run(8.0);
    EXPECT_TRUE(loop.controller.arrived());
    EXPECT_LT(loop.distance(q, 0), 3.0 * kDegree);
    EXPECT_LT(loop.distance(q, 1), 3.0 * kDegree);
  }
  loop.controller.zero_gravity();
  const auto left_at = loop.sim.configuration();
  loop.run(5.0);
  EXPECT_LT(loop.distance(left_at, 0), 2.0 * kDegree);
}

TEST(ComputedForce, VoltagesForgetWhatTheyIntegratedBeforeAMove) {
  const auto model = load_robot_model(kAnthrob + "model_I.yaml");
  auto settings = ControlSettings::load(kAnthrob + "control.yaml", *model);
  settings.hold_output = ecu::Mode::kVoltage;
  settings.move_output = ecu::Mode::kPosition;
  ComputedForce controller(model, settings);
  RobotMeasurement measured{model->skeleton->rest_configuration(),
                            Eigen::VectorXd::Zero(model->skeleton->velocity_count),
                            std::vector<ecu::Measurement>(model->muscles.size())};
  const auto update = [&] { return controller.update(measured, 0.005); };
  // All tendons 1 N slacker than they should be.
  const Eigen::VectorXd tension = update().tension;
  for (std::size_t m = 0; m < measured.muscles.size(); ++m) {
    measured.muscles[m].force = tension[static_cast<Eigen::Index>(m)] - 1.0;
  }
  controller.reset();
  const std::vector<double> first = update().reference;
  for (int i = 0; i < 100; ++i) update();
  ASSERT_GT(update().reference[0], first[0] + 0.1);
  controller.go_to(measured.q, 0.1);
  for (int i = 0; i < 100; ++i) update();
  controller.zero_gravity();
  const std::vector<double> again = update().reference;
  for (std::size_t m = 0; m < first.size(); ++m) EXPECT_NEAR(again[m], first[m], 1e-3) << m;
}

TEST(ComputedForce, VoltagesDoNotJumpAfterAPause) {
  const auto model = load_robot_model(kAnthrob + "model_I.yaml");
  auto settings = ControlSettings::load(kAnthrob + "control.yaml", *model);
  settings.hold_output = ecu::Mode::kVoltage;
  RobotMeasurement measured{model->skeleton->rest_configuration(),
                            Eigen::VectorXd::Zero(model->skeleton->velocity_count),
                            std::vector<ecu::Measurement>(model->muscles.size())};
  // What a pause of 0.45 s adds to the voltages.
  const auto jump = [&](double pause) {
    ComputedForce controller(model, settings);
    const Eigen::VectorXd tension = controller.update(measured, 0.005).tension;
    for (std::size_t m = 0; m < measured.muscles.size(); ++m) {
      measured.muscles[m].force = tension[static_cast<Eigen::Index>(m)] - 1.0;
    }
    for (int i = 0; i < 100; ++i) controller.update(measured, 0.005);
    const double before = controller.update(measured, 0.005).reference[0];
    return controller.update(measured, pause).reference[0] - before;
  };
  EXPECT_GT(jump(0.005), 0.0);
  EXPECT_NEAR(jump(0.45), jump(0.1), 1e-9);
}

TEST(ComputedForce, StaysNearThePostureWithAWrongModel) {
  // Straight muscles in the controller, wrapping ones on the robot: gravity and moment arms are off
  // by some per cent, a servo makes up for it.
  const auto plant = load_robot_model(kAnthrob + "model_II.yaml");
  const auto model = load_robot_model(kAnthrob + "model_I.yaml");
  const auto settings = ControlSettings::load(kAnthrob + "control.yaml", *model);
  const std::vector<double> q = reachable_postures(plant, 2)[1];
  ClosedLoop loop(plant, model, settings, kNoise);
  loop.place(q);
  loop.run(1.0);
  loop.controller.go_to(q, 1.0);
  loop.run(12.0);
  EXPECT_LT(loop.distance(q, 0), 1.0 * kDegree);
  EXPECT_LT(loop.distance(q, 1), 1.0 * kDegree);
}

TEST(ComputedForce, YieldsToAHandAndStaysWhereItIsLeft) {
  const auto plant = load_robot_model(kAnthrob + "model_II.yaml");
  const auto settings = ControlSettings::load(kAnthrob + "control.yaml", *plant);
  const int elbow = plant->skeleton->find_joint("elbow");
  const std::vector<double> q{1, 0, 0, 0, 1.0};
  ClosedLoop loop(plant, plant, settings);
  loop.place(q);
  loop.run(1.0);
  loop.sim.apply_load(elbow, 0.5 * settings.joints[1].yield);
  loop.run(3.0);
  EXPECT_LT(loop.distance(q, elbow), 6.0 * kDegree);  // a light push is resisted
  loop.sim.apply_load(elbow, 3.0 * settings.joints[1].yield);
  loop.run(1.5);
  loop.sim.apply_load(elbow, 0.0);
  loop.run(1.0);
  const auto left_at = loop.sim.configuration();
  EXPECT_GT(loop.distance(q, elbow), 15.0 * kDegree);  // a strong one moves the arm
  loop.run(5.0);
  // It springs back by what it takes to yield.
  const double give = settings.joints[1].yield / settings.joints[1].stiffness;
  EXPECT_LT(loop.distance(left_at, elbow), give + 1.0 * kDegree);
}

TEST(ComputedForce, SaysHonestlyWhatTheMusclesCannotDo) {
  const auto plant = load_robot_model(kAnthrob + "model_II.yaml");
  auto settings = ControlSettings::load(kAnthrob + "control.yaml", *plant);
  settings.highest_tension = 3.0;
  ClosedLoop loop(plant, plant, settings);
  loop.place({0.939693, 0.220336, 0.0, -0.261591, 1.0});
  loop.run(0.01);
  EXPECT_GT(loop.command->shortfall.norm(), 0.1);
  EXPECT_LE(loop.command->tension.maxCoeff(), 3.0);
}

TEST(ComputedForce, SameInputSameBits) {
  const auto plant = with_noisy_sensors("model_II.yaml");
  const auto settings = ControlSettings::load(kAnthrob + "control.yaml", *plant);
  std::vector<double> first;
  for (int run = 0; run < 2; ++run) {
    ClosedLoop loop(plant, plant, settings, kNoise);
    loop.run(1.0);
    if (run == 0) first = loop.sim.configuration();
    EXPECT_EQ(loop.sim.configuration(), first);
  }
}

TEST(ComputedForce, RefusesPositionsThatNoGainHolds) {
  const std::string folder = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/";
  const auto model = load_robot_model(folder + "model_I.yaml",
                                      {1e-3, {{"controllers.type_1.position.proportional", 0.0}}});
  ControlSettings settings = ControlSettings::load(folder + "control.yaml", *model);
  settings.move_output = settings.hold_output = ecu::Mode::kForce;
  ComputedForce by_force(model, settings);
  settings.move_output = ecu::Mode::kPosition;
  EXPECT_THROW(ComputedForce(model, settings), BadInput);
}

TEST(ComputedForce, DrivesTurnEitherWay) {
  const auto plant = load_robot_model(std::string(ANTHROB_CONFIG_DIR) +
                                      "/../src/anthrob_sim/templates/robot/servo/model_I.yaml");
  ControlSettings settings;
  settings.joints.resize(1);
  for (const double angle : {0.7, -0.7}) {
    ClosedLoop loop(plant, plant, settings);
    loop.place({angle});
    loop.run(3.0);
    EXPECT_LT(loop.distance({angle}, 0), 0.05) << angle;
    EXPECT_GT(loop.sim.muscle(0).force() * std::sin(angle), 0.05) << "against gravity";
  }
}

TEST(ComputedForce, RefusesRobotsThatCannotTakeItsCommands) {
  const std::string rig = std::string(ANTHROB_CONFIG_DIR) + "/two_muscle_rig/";
  const auto hill = load_robot_model(rig + "model_hill.yaml");
  ControlSettings settings;
  settings.joints.resize(1);
  EXPECT_THROW(ComputedForce(hill, settings), BadInput);  // nobody takes commands
  auto blind = std::make_shared<RobotModel>(*load_robot_model(rig + "model_I.yaml"));
  for (MuscleModel& muscle : blind->muscles) muscle.limits.force = 0.0;
  ASSERT_FALSE(blind->muscles[0].has_force_sensor());
  EXPECT_THROW(ComputedForce(blind, settings), BadInput);  // nobody takes FORCE
  settings.hold_output = ecu::Mode::kPosition;
  EXPECT_NO_THROW(ComputedForce(blind, settings));
}

TEST(ComputedForce, RefusesMeasurementsThatDoNotFit) {
  const auto plant = load_robot_model(kAnthrob + "model_I.yaml");
  const auto settings = ControlSettings::load(kAnthrob + "control.yaml", *plant);
  ComputedForce controller(plant, settings);
  RobotMeasurement m{
      {1, 0, 0, 0, NAN}, Eigen::VectorXd::Zero(4), std::vector<ecu::Measurement>(11)};
  EXPECT_THROW(controller.update(m, 0.005), std::invalid_argument);
  m.q[4] = 0.0;
  EXPECT_NO_THROW(controller.update(m, 0.005));
  m.muscles.pop_back();
  EXPECT_THROW(controller.update(m, 0.005), std::invalid_argument);
  EXPECT_THROW(controller.go_to({1, 0, 0, 0}, 1.0), std::invalid_argument);
  EXPECT_THROW(controller.go_to({1, 0, 0, 0, 0}, 0.0), std::invalid_argument);
  EXPECT_TRUE(controller.holds());
}

/// The elbow, 1 rad away, stands still.
class GoTo : public ::testing::Test {
 protected:
  GoTo()
      : settings(ControlSettings::load(kAnthrob + "control.yaml", *robot)),
        controller(robot, settings),
        measured{robot->skeleton->rest_configuration(), Eigen::VectorXd::Zero(4),
                 std::vector<ecu::Measurement>(11)} {
    measured.q[4] = 0.5;
    controller.update(measured, 0.005);
    aim = measured.q;
    aim[4] = 1.5;
  }

  std::shared_ptr<const RobotModel> robot = load_robot_model(kAnthrob + "model_I.yaml");
  ControlSettings settings;
  ComputedForce controller;
  RobotMeasurement measured;
  std::vector<double> aim;
};

TEST_F(GoTo, RefusesHaste) {
  const double shortest = 1.875 / 4.0;
  try {
    controller.go_to(aim, 0.98 * shortest);
    FAIL() << "no refusal";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("'elbow' would move at 4.08 rad/s"), std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(controller.holds());
  controller.go_to(aim, 1.02 * shortest);
  double fastest = 0.0, last = 0.5;
  for (int i = 0; i < 120; ++i) {
    controller.update(measured, 0.005);
    fastest = std::max(fastest, (controller.target()[4] - last) / 0.005);
    last = controller.target()[4];
  }
  EXPECT_NEAR(fastest, 4.0 / 1.02, 0.02);
  EXPECT_EQ(last, 1.5);
}

TEST_F(GoTo, RefusesWhatIsBeyondTheLimitOfAMuscle) {
  auto limited = std::make_shared<RobotModel>(*robot);
  for (MuscleModel& muscle : limited->muscles) muscle.limits.position = 1.0;
  ComputedForce other(limited, settings);
  other.update(measured, 0.005);
  try {
    other.go_to(aim, 2.0);
    FAIL() << "no refusal";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("expected at most 1.000000 rad, its position limit"),
              std::string::npos)
        << error.what();
  }
  EXPECT_TRUE(other.holds());
  // On the way, where what is measured decides, it is said.
  EXPECT_FALSE(controller.update(measured, 0.005).limited);
  settings.hold_output = ecu::Mode::kPosition;
  ComputedForce holding(limited, settings);
  EXPECT_TRUE(holding.update(measured, 0.005).limited);
}

TEST_F(GoTo, RefusesNoDuration) {
  for (const double duration : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(controller.go_to(aim, duration), std::invalid_argument) << duration;
  }
}

TEST_F(GoTo, WaitsWhereItWasHeldUp) {
  controller.go_to(aim, 1.0);
  for (int i = 0; i < 80; ++i) controller.update(measured, 0.005);
  const double before = controller.target()[4];
  controller.update(measured, 0.4);
  EXPECT_LT(controller.target()[4] - before, 0.1 * 1.875);
  EXPECT_GT(controller.target()[4], before);
}

TEST_F(GoTo, BeginsAnewWhereItWasLeftAloneForLong) {
  controller.go_to(aim, 1.0);
  for (int i = 0; i < 80; ++i) controller.update(measured, 0.005);
  ASSERT_FALSE(controller.holds());
  controller.update(measured, 0.6);
  EXPECT_TRUE(controller.holds());
  EXPECT_EQ(controller.target(), measured.q);
}

TEST(ControlSettings, RefusesWhatItCannotUse) {
  const auto model = load_robot_model(kAnthrob + "model_I.yaml");
  std::ifstream in(kAnthrob + "control.yaml");
  const std::string good((std::istreambuf_iterator<char>(in)), {});
  const std::pair<const char*, const char*> cases[][2] = {
      {{"rate: 200", "rate: 0"}, {"", "rate"}},
      {{"hold: FORCE", "hold: CURRENT"}, {"", "FORCE, POSITION or VOLTAGE"}},
      {{"lowest: 2.0", "lowest: -1"}, {"", "tension.lowest"}},
      {{"elbow:", "knee:"}, {"", "knee"}},
      {{"stiffness: 1.0", "stifness: 1.0"}, {"", "stiffness"}},
      {{"stale_after: 0.1", "stale_after: 0.1\nspeed: 3"}, {"", "unknown key"}},
  };
  const std::string file = "/tmp/anthrob_settings_" + std::to_string(getpid()) + ".yaml";
  for (const auto& test : cases) {
    std::string text = good;
    const auto at = text.find(test[0].first);
    ASSERT_NE(at, std::string::npos) << test[0].first;
    text.replace(at, std::string(test[0].first).size(), test[0].second);
    std::ofstream(file) << text;
    try {
      ControlSettings::load(file, *model);
      ADD_FAILURE() << test[0].second;
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find(test[1].second), std::string::npos) << error.what();
    }
  }
  std::remove(file.c_str());
}

}  // namespace
}  // namespace anthrob
