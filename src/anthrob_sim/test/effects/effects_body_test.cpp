// Effects on bodies, joints and sensors, each against a closed form, and what they dissipate.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "effects_support.h"

namespace anthrob {
namespace {

using namespace testing_support;

const char* const kAxis = "driven_axis/model_I.yaml";
constexpr double kViscous = 203.5, kMass = 95.1;  // of the driven axis [Ns/m, kg]

/// Speed of the driven axis after a time under a constant effort, from rest.
double speed_of_axis(const std::vector<EffectInstance>& effects, double effort, int steps = 1500) {
  Simulation sim(robot_with(kAxis, effects));
  sim.apply_effort(0, effort);
  sim.step(steps);
  return sim.tree().velocities()[0];
}

/// The closed form of that, for a force that friction leaves and a damping.
double expected_speed(double force, double damping, double seconds = 1.5) {
  return force / damping * -std::expm1(-damping * seconds / kMass);
}

TEST(DrivenAxis, FollowsItsEquationOfMotion) {
  EXPECT_NEAR(speed_of_axis({}, 40.0), expected_speed(40.0, kViscous), 1e-3 * 0.2);
  Simulation sim(robot_with(kAxis, {}));
  EXPECT_EQ(sim.model().skeleton->joints[0].name, "axis");
}

TEST(JointViscous, AddsDamping) {
  EXPECT_NEAR(speed_of_axis({{"joint_viscous", "axis", {{"damping", 100.0}}}}, 40.0),
              expected_speed(40.0, kViscous + 100.0), 2e-4);
}

TEST(JointCoulomb, HoldsBelowBreakawayAndTakesAConstantForceAbove) {
  const std::vector<EffectInstance> effects = {
      {"joint_coulomb",
       "axis",
       {{"torque", 20.0}, {"static_ratio", 1.5}, {"stribeck_velocity", 0.001}}}};
  EXPECT_EQ(speed_of_axis(effects, 29.0), 0.0);
  EXPECT_EQ(speed_of_axis(effects, -29.0), 0.0);
  EXPECT_GT(speed_of_axis(effects, 31.0), 0.02);
  EXPECT_LT(speed_of_axis(effects, -31.0), -0.02);
  // One second: in 1.5 s it would get to the stop.
  EXPECT_NEAR(speed_of_axis(effects, 45.0, 1000), expected_speed(25.0, kViscous, 1.0), 1e-3);
  EXPECT_NEAR(speed_of_axis(effects, -45.0, 1000), -expected_speed(25.0, kViscous, 1.0), 1e-3);
}

TEST(JointCoulomb, SharesTheStribeckCurveWithTheModelsFriction) {
  const auto friction = [](const std::vector<EffectInstance>& effects) {
    return robot_with("two_muscle_rig/model_I.yaml", effects)->skeleton->joints[0].friction;
  };
  const auto velocity = [&](double torque, double static_ratio) {
    return friction(
               {{"joint_coulomb",
                 "hinge",
                 {{"torque", torque}, {"static_ratio", static_ratio}, {"stribeck_velocity", 0.5}}}})
        .stribeck_velocity;
  };
  const JointFrictionModel plain = friction({});
  const double more = plain.static_torque - plain.kinetic_torque;
  ASSERT_GT(more, 0.0);
  ASSERT_LT(plain.stribeck_velocity, 0.1);
  // Next to nothing changes next to nothing; friction without excess at rest has no velocity.
  EXPECT_NEAR(velocity(1e-9, 1.5), plain.stribeck_velocity, 1e-6);
  EXPECT_DOUBLE_EQ(velocity(1.0, 1.0), plain.stribeck_velocity);
  EXPECT_NEAR(velocity(2.0 * more, 1.5), 0.5 * (plain.stribeck_velocity + 0.5), 1e-12);
  EXPECT_NEAR(velocity(1e3 * more, 1.5), 0.5, 1e-3);
}

TEST(JointCoulombAsymmetric, TakesAnotherForceInEachDirection) {
  const std::vector<EffectInstance> effects = {
      {"joint_coulomb_asymmetric", "axis", {{"forward", 17.2}, {"backward", 23.6}}}};
  EXPECT_EQ(speed_of_axis(effects, 17.0), 0.0);
  EXPECT_EQ(speed_of_axis(effects, -23.0), 0.0);
  EXPECT_NEAR(speed_of_axis(effects, 17.5), expected_speed(17.5 - 17.2, kViscous), 2e-4);
  EXPECT_NEAR(speed_of_axis(effects, -24.0), -expected_speed(24.0 - 23.6, kViscous), 2e-4);
  EXPECT_NEAR(speed_of_axis(effects, 40.0), expected_speed(40.0 - 17.2, kViscous), 2e-4);
  EXPECT_NEAR(speed_of_axis(effects, -40.0), -expected_speed(40.0 - 23.6, kViscous), 2e-4);
}

TEST(JointOffsetTorque, AddsAConstantForce) {
  EXPECT_NEAR(speed_of_axis({{"joint_offset_torque", "axis", {{"torque", -3.16}}}}, 40.0),
              expected_speed(40.0 - 3.16, kViscous), 2e-4);
}

TEST(JointOffsetTorque, BesideMoreFrictionItIsFrictionThatDiffersByDirection) {
  const std::vector<EffectInstance> offset = {
      {"joint_coulomb", "axis", {{"torque", 20.4}, {"static_ratio", 1.0}}},
      {"joint_offset_torque", "axis", {{"torque", -3.2}}}};
  const std::vector<EffectInstance> asymmetric = {
      {"joint_coulomb_asymmetric", "axis", {{"forward", 23.6}, {"backward", 17.2}}}};
  for (const double effort : {40.0, -40.0, 24.0, 23.0, -17.0, -18.0, 0.0}) {
    EXPECT_NEAR(speed_of_axis(offset, effort), speed_of_axis(asymmetric, effort), 1e-9) << effort;
  }
  EXPECT_EQ(speed_of_axis(offset, 23.0), 0.0);
  EXPECT_EQ(speed_of_axis(offset, -17.0), 0.0);
  // An offset that is more than the friction moves the joint by itself; friction never does.
  EXPECT_LT(speed_of_axis({{"joint_coulomb", "axis", {{"torque", 2.0}, {"static_ratio", 1.0}}},
                           {"joint_offset_torque", "axis", {{"torque", -3.2}}}},
                          0.0),
            -1e-3);
}

/// Where the energy of a joint that is driven to and fro goes: share that is not accounted for.
double unexplained_joint_work(const std::vector<EffectInstance>& effects, double step) {
  Simulation sim(robot_with(kAxis, effects, step));
  double work = 0.0, heat = 0.0, turned_over = 0.0;
  const double start = audit_energy(sim).kinetic + audit_energy(sim).potential;
  for (int i = 0; i < static_cast<int>(std::lround(4.0 / step)); ++i) {
    const double before = sim.configuration()[0], effort = 60.0 * std::sin(4.0 * sim.time());
    sim.apply_effort(0, effort);
    sim.step();
    work += effort * (sim.configuration()[0] - before);
    turned_over += std::abs(effort * (sim.configuration()[0] - before));
    heat += sim.last_step().joint_dissipation * step;
  }
  EXPECT_GT(heat, 0.0);
  // What friction bends and could give back counts as energy of the joint.
  heat -= sim.presliding_energy();
  const double stored = audit_energy(sim).kinetic + audit_energy(sim).potential - start;
  return std::abs(work - stored - heat) / turned_over;
}

TEST(JointEffects, EnergyIsAccountedFor) {
  const std::vector<std::vector<EffectInstance>> cases = {
      {{"joint_viscous", "axis", {{"damping", 100.0}}}},
      {{"joint_coulomb", "axis", {{"torque", 20.0}}}},
      {{"joint_coulomb_asymmetric", "axis", {{"forward", 10.0}, {"backward", 20.0}}}},
      {{"joint_offset_torque", "axis", {{"torque", 5.0}}}},
      {{"cable_drag", "axis", {{"stiffness", 300.0}, {"rest", 0.05}}}},
      {{"joint_quadratic_drag", "axis", {{"drag", 400.0}}}},
      {{"joint_presliding", "axis", {{"torque", 20.0}, {"distance", 0.002}}}},
      {{"joint_lugre",
        "axis",
        {{"torque", 20.0},
         {"distance", 0.002},
         {"static_ratio", 1.5},
         {"stribeck_velocity", 0.02}}}},
      {{"joint_effort_friction", "axis", {{"share", 0.3}}}},
      {{"joint_ripple", "axis", {{"sine_1", 10.0}, {"cosine_2", 8.0}}}},
  };
  for (const auto& effects : cases) {
    const double coarse = unexplained_joint_work(effects, 1e-3);
    const double fine = unexplained_joint_work(effects, 1e-4);
    EXPECT_LT(coarse, 1e-2) << effects[0].id;
    EXPECT_LT(fine, 0.3 * coarse + 1e-6) << effects[0].id;
  }
}

TEST(CableDrag, BalancesAForceWhereHookeSays) {
  const double stiffness = 400.0, rest = 0.03;
  Simulation sim(
      robot_with(kAxis, {{"cable_drag", "axis", {{"stiffness", stiffness}, {"rest", rest}}}}));
  sim.apply_effort(0, 20.0);
  sim.step(20000);
  EXPECT_NEAR(sim.configuration()[0], rest + 20.0 / stiffness, 1e-6);
}

TEST(CableDrag, TorqueOnABallJointIsTheGradientOfItsEnergy) {
  const auto robot = robot_with(kArm, {{"cable_drag", "shoulder", {{"stiffness", 0.3}}}});
  const JointTorque& cable = *robot->joint_torques.at(0);
  Simulation sim(robot);
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> q = random_posture(random);
    sim.place(q, std::vector<double>(11, 0.0));
    double tau[4] = {0.0, 0.0, 0.0, 0.0};
    cable.add(sim.tree(), q, tau);
    const Vec3 torque_C = sim.tree().joint(0).R_WC.transpose() * Vec3(tau[0], tau[1], tau[2]);
    for (int k = 0; k < 3; ++k) {
      double energy[2];
      for (int side = 0; side < 2; ++side) {
        const Quat turn(Eigen::AngleAxisd(side == 0 ? -1e-5 : 1e-5, Vec3::Unit(k)));
        const Quat r = Quat(q[0], q[1], q[2], q[3]) * turn;
        energy[side] = cable.energy({r.w(), r.x(), r.y(), r.z(), q[4]});
      }
      EXPECT_NEAR(torque_C[k], -(energy[1] - energy[0]) / 2e-5, 1e-7);
    }
  }
}

TEST(GravityTilt, TurnsGravityAgainstTheTiltOfTheBase) {
  const auto robot = robot_with(kArm, {{"gravity_tilt", "x", {{"angle", 0.1}}}});
  // A base tilted forwards about x has gravity with a part along -y sin... : seen from the base.
  EXPECT_NEAR((robot->gravity - 9.81 * Vec3(0.0, -std::sin(0.1), -std::cos(0.1))).norm(), 0.0,
              1e-12);
  const auto places = find_effect("gravity_tilt")->places(*load_robot_model(config(kArm)));
  EXPECT_EQ(places, (std::vector<std::string>{"x", "y"}));
  EXPECT_TRUE(find_effect("gravity_tilt")->places(*load_robot_model(config(kAxis))).empty());
}

TEST(GravityTilt, AboutTheVerticalIsRefusedBesideAnotherTiltToo) {
  const EffectInstance x = {"gravity_tilt", "x", {{"angle", 0.1}}};
  const EffectInstance y = {"gravity_tilt", "y", {{"angle", 0.1}}};
  const EffectInstance z = {"gravity_tilt", "z", {{"angle", 0.1}}};
  EXPECT_NO_THROW(robot_with(kArm, {x, y}));
  EXPECT_THROW(robot_with(kArm, {z}), BadInput);
  EXPECT_THROW(robot_with(kArm, {x, z}), BadInput);
}

TEST(Payload, MassCentreAndInertiaAreThoseOfBoth) {
  const double mass = 0.25;
  const Vec3 d(0.01, -0.02, 0.05);
  const auto plain = load_robot_model(config(kArm));
  const auto robot = robot_with(
      kArm, {{"payload", "forearm", {{"mass", mass}, {"x", d[0]}, {"y", d[1]}, {"z", d[2]}}}});
  const BodyModel &a = plain->skeleton->bodies[2], &b = robot->skeleton->bodies[2];
  ASSERT_EQ(b.name, "forearm");
  EXPECT_NEAR(b.mass, a.mass + mass, 1e-12);
  EXPECT_NEAR((b.com_L - a.com_L - mass / b.mass * d).norm(), 0.0, 1e-12);
  // About the old centre of mass: Steiner backwards, and the point mass alone.
  const auto shift = [](double m, const Vec3& r) -> Mat3 {
    return m * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
  };
  const Mat3 about_old = b.inertia_L + shift(b.mass, b.com_L - a.com_L);
  EXPECT_NEAR((about_old - a.inertia_L - shift(mass, d)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((b.X_LB.R * b.principal.asDiagonal() * b.X_LB.R.transpose() - b.inertia_L).norm(),
              0.0, 1e-12);
  // Paths stay where they are.
  Simulation before(plain), after(robot);
  for (int m = 0; m < 11; ++m) {
    EXPECT_NEAR(before.muscle(m).length(), after.muscle(m).length(), 1e-12);
  }
}

TEST(Payload, WhatNoBodyCanLackIsRefused) {
  // The forearm's mass lies less than a centimetre (rms) from its long axis: a fifth of it cannot
  // be 20 mm aside; without it the largest moment would exceed the sum of the other two.
  const auto lacking = [](double share) {
    const double mass = -share * load_robot_model(config(kArm))->skeleton->bodies[2].mass;
    const EffectInstance payload = {
        "payload", "forearm", {{"mass", mass}, {"x", 0.02}, {"y", 0.0}, {"z", 0.0}}};
    try {
      const Vec3 left = robot_with(kArm, {payload})->skeleton->bodies[2].principal;
      EXPECT_LE(left.maxCoeff(), 0.5 * left.sum());
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string("(accepted)");
  };
  EXPECT_EQ(lacking(0.1), "(accepted)");
  EXPECT_NE(
      lacking(0.2).find("expected a number for which the body keeps principal moments of inertia "
                        "> 0, none larger than the other two together [kg]"),
      std::string::npos)
      << lacking(0.2);
}

TEST(BallJointLoadFriction, PendulumLosesTheSameAmplitudeEveryHalfSwing) {
  // A small mass on a ball joint swings in one plane: 2 mu r / l less every half period.
  const double length = 0.5, mu = 0.2, radius = 0.01;
  const std::string urdf =
      "<robot name=\"p\"><link name=\"world\"/><joint name=\"ball\" type=\"floating\"><parent "
      "link=\"world\"/><child link=\"bob\"/></joint><link name=\"bob\"><inertial><origin "
      "xyz=\"0 0 -0.5\"/><mass value=\"2\"/><inertia ixx=\"1e-3\" ixy=\"0\" ixz=\"0\" iyy=\"1e-3\" "
      "iyz=\"0\" izz=\"1e-3\"/></inertial></link></robot>";
  const std::string model =
      "robot: robot.urdf\ngravity: [0, 0, -9.81]\njoints:\n  ball: {type: ball, center: [0, 0, "
      "0]}\neffects:\n  - {id: ball_joint_load_friction, place: ball, mu: 0.2, radius: 0.01}\n";
  Simulation sim(TemporaryRobot(urdf, model).load(1e-4));
  const double start = 0.2;
  sim.place({std::cos(0.5 * start), std::sin(0.5 * start), 0.0, 0.0}, {});
  const double begin = audit_energy(sim).potential;
  double heat = 0.0, last = start;
  std::vector<double> turning;
  double speed = 0.0;
  for (int i = 0; i < 45000; ++i) {
    sim.step();
    heat += sim.last_step().joint_dissipation * 1e-4;
    const double angle = 2.0 * std::atan2(sim.configuration()[1], sim.configuration()[0]);
    if ((angle - last) * speed < 0.0) turning.push_back(std::abs(angle));
    speed = angle - last;
    last = angle;
  }
  ASSERT_GE(turning.size(), 4u);
  const double loss = 2.0 * mu * radius / length;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(turning[i], start - loss * static_cast<double>(i + 1), 0.05 * loss * (i + 1.0));
  }
  const double end = audit_energy(sim).potential + audit_energy(sim).kinetic;
  EXPECT_NEAR(begin - end, heat, 0.01 * heat);
}

// --- sensors
// --------------------------------------------------------------------------------------

TEST(ForceSensor, ReadsWithOffsetDriftAndGain) {
  Simulation sim(
      robot_with(kArm, {{"force_sensor_offset", "brachialis", {{"offset", 1.5}, {"drift", 0.2}}},
                        {"force_sensor_gain", "biceps_brachii", {{"gain", 1.1}}}}));
  const int brachialis = sim.model().find_muscle("brachialis");
  const int biceps = sim.model().find_muscle("biceps_brachii");
  run(sim, 500);
  EXPECT_NEAR(sim.reading(brachialis).force, sim.muscle(brachialis).force() + 1.5 + 0.2 * 0.5,
              1e-9);
  EXPECT_GT(sim.muscle(biceps).force(), 1.0);
  EXPECT_NEAR(sim.reading(biceps).force, 1.1 * sim.muscle(biceps).force(), 1e-12);
  EXPECT_EQ(sim.reading(0).force, sim.muscle(0).force());
  // The ECU sees what the sensor reads.
  EXPECT_EQ(sim.muscle(biceps).measured().force, sim.reading(biceps).force);
}

TEST(ForceCrosstalk, AddsAShareOfTheNeighbour) {
  Simulation sim(
      robot_with(kArm, {{"force_crosstalk", "teres_minor/brachialis", {{"share", 0.05}}}}));
  run(sim, 300);
  const int to = sim.model().find_muscle("teres_minor");
  const int from = sim.model().find_muscle("brachialis");
  EXPECT_GT(sim.muscle(from).force(), 1.0);
  EXPECT_NEAR(sim.reading(to).force, sim.muscle(to).force() + 0.05 * sim.muscle(from).force(),
              1e-12);
}

TEST(ForceCrosstalk, WhatOnePicksUpItDoesNotPassOn) {
  const std::vector<std::string> names = {"brachialis", "teres_minor", "biceps_brachii"};
  const auto talk = [&names](int to, int from, double share) {
    return EffectInstance{"force_crosstalk", names[to] + "/" + names[from], {{"share", share}}};
  };
  // Both directions of a pair; a chain along the alphabet and one against it; all, with a gain.
  const std::vector<std::vector<std::array<double, 3>>> cases = {
      {{0, 1, 0.3}, {1, 0, 0.2}},
      {{1, 0, 0.3}, {2, 1, 0.2}},
      {{0, 2, 0.3}, {1, 0, -0.2}},
      {{0, 1, 0.1}, {0, 2, 0.2}, {1, 0, 0.3}, {1, 2, 0.4}, {2, 0, 0.5}, {2, 1, 0.15}}};
  for (const auto& pairs : cases) {
    std::vector<EffectInstance> effects = {{"force_sensor_gain", names[0], {{"gain", 1.5}}}};
    for (const auto& p : pairs) {
      effects.push_back(talk(static_cast<int>(p[0]), static_cast<int>(p[1]), p[2]));
    }
    Simulation sim(robot_with(kArm, effects));
    int muscle[3];
    for (int i = 0; i < 3; ++i) muscle[i] = sim.model().find_muscle(names[i]);
    for (int i = 1; i <= 200; ++i) {
      for (const int m : muscle) sim.muscle_inputs().impose_position(m, 0.01 * i, 10.0);
      sim.step();
    }
    double expected[3];
    for (int i = 0; i < 3; ++i) expected[i] = sim.muscle(muscle[i]).force();
    for (const auto& p : pairs) {
      expected[static_cast<int>(p[0])] += p[2] * sim.muscle(muscle[static_cast<int>(p[1])]).force();
    }
    expected[0] *= 1.5;
    for (int i = 0; i < 3; ++i) {
      EXPECT_GT(sim.muscle(muscle[i]).force(), 1.0);
      EXPECT_NEAR(sim.reading(muscle[i]).force, expected[i], 1e-12) << names[i];
    }
  }
}

TEST(EncoderDrift, FollowsTimeAndTravel) {
  Simulation sim(
      robot_with(kArm, {{"encoder_drift", "brachialis", {{"rate", 0.01}, {"missed", 0.1}}}}));
  const int m = sim.model().find_muscle("brachialis");
  for (int i = 1; i <= 1000; ++i) {  // there and half the way back
    const double position = i <= 600 ? 0.002 * i : 2.4 - 0.002 * i;
    sim.muscle_inputs().impose_position(m, position, 0.0);
    sim.step();
  }
  EXPECT_NEAR(sim.muscle(m).actuator().position, 0.4, 1e-12);
  EXPECT_NEAR(sim.reading(m).position, 0.4 + 0.01 * 1.0 - 0.1 * 2.0, 1e-9);
}

TEST(SensingLatency, ReadsThePastOfAllChannels) {
  using Channel = double ecu::Measurement::*;
  const Channel channels[] = {&ecu::Measurement::position, &ecu::Measurement::velocity,
                              &ecu::Measurement::current, &ecu::Measurement::force};
  const double delay = 0.0045;
  Simulation sim(robot_with(kArm, {{"sensing_latency", "all", {{"delay", delay}}}}));
  std::vector<ecu::Measurement> truth, read;
  for (int i = 0; i < 300; ++i) {
    run(sim, 1);
    truth.push_back(sim.muscle(3).truth());
    read.push_back(sim.reading(3));
  }
  for (const Channel channel : channels) {
    double moved = 0.0;
    for (std::size_t i = 10; i < truth.size(); ++i) {
      const double past = 0.5 * (truth[i - 4].*channel + truth[i - 5].*channel);
      EXPECT_NEAR(read[i].*channel, past, 1e-12);
      moved = std::max(moved, std::abs(truth[i].*channel - past));
    }
    EXPECT_GT(moved, 1e-3);
  }
}

TEST(ReadingEffects, BeginAsIfThoseBeforeThemHadAlwaysBeenThere) {
  Simulation sim(robot_with(kRig, {{"force_sensor_offset", "flexor", {{"offset", 5.0}}},
                                   {"force_sensor_offset", "extensor", {{"drift", 1.0}}},
                                   {"force_sensor_gain", "flexor", {{"gain", 1.1}}},
                                   {"encoder_drift", "flexor", {{"missed", 0.2}}},
                                   {"sensing_latency", "all", {{"delay", 0.1}}}}));
  sim.place({0.0}, {3.0, 2.0});
  const double force = sim.muscle(0).force(), other = sim.muscle(1).force();
  ASSERT_GT(force, 1.0);
  for (int i = 0; i <= 100; ++i) {
    ASSERT_NEAR(sim.reading(0).force, 1.1 * force + 5.0, 1e-12) << i;
    ASSERT_NEAR(sim.reading(0).position, 3.0, 1e-12) << i;
    ASSERT_NEAR(sim.reading(1).force, other, 1e-12) << i;
    sim.step();
  }
  // Drift goes by the time since then.
  const double then = sim.muscle(1).force();
  sim.step(100);
  EXPECT_NEAR(sim.reading(1).force, then + 0.101, 1e-12);
}

TEST(ReadingEffects, SensorsWithADelayBeginWithWhatTheyWouldHaveRead) {
  const TemporaryRobot robot("", "extends: " + config(kArm) + R"(
sensors:
  force: {delay: 0.05}
  joint_position: {delay: 0.05}
effects:
  - {id: force_sensor_offset, place: brachialis, offset: 5.0}
  - {id: mocap_misalignment, place: y, angle: 0.2}
)");
  Simulation sim(robot.load());
  const int m = sim.model().find_muscle("brachialis");
  const double force = sim.muscle(m).force();
  for (int i = 0; i <= 50; ++i) {
    ASSERT_NEAR(sim.muscle(m).measured().force, force + 5.0, 1e-12) << i;
    ASSERT_NEAR(sim.measured_joint_position(0), std::cos(0.1), 1e-12) << i;
    sim.step();
  }
}

TEST(MocapDelay, ReadsThePastOfAllJoints) {
  Simulation sim(robot_with(kArm, {{"mocap_delay", "global", {{"delay", 0.02}}}}));
  std::vector<std::vector<double>> truth;
  std::vector<double> elbow;
  std::vector<Vec3> shoulder;
  double elbow_moved = 0.0, shoulder_moved = 0.0;
  for (int i = 0; i < 300; ++i) {
    run(sim, 1);
    truth.push_back(sim.configuration());
    elbow.push_back(sim.tree().velocities()[3]);
    shoulder.push_back(sim.tree().ball_velocity(0));
    if (i < 30) continue;
    const double* read = sim.read_positions();
    for (int k = 0; k < 5; ++k) EXPECT_NEAR(read[k], truth[i - 20][k], 1e-9);
    EXPECT_NEAR(sim.read_velocity(1), elbow[i - 20], 1e-9);
    EXPECT_NEAR((sim.read_ball_velocity(0) - shoulder[i - 20]).norm(), 0.0, 1e-9);
    elbow_moved = std::max(elbow_moved, std::abs(elbow[i] - elbow[i - 20]));
    shoulder_moved = std::max(shoulder_moved, (shoulder[i] - shoulder[i - 20]).norm());
  }
  EXPECT_GT(elbow_moved, 1e-3);
  EXPECT_GT(shoulder_moved, 1e-3);
}

TEST(MocapMisalignment, TurnsReadingsAboutAnAxisOfTheWorld) {
  const double angle = 0.05;
  Simulation sim(robot_with(kArm, {{"mocap_misalignment", "y", {{"angle", angle}}}}));
  run(sim, 400);
  const double *read = sim.read_positions(), *q = sim.configuration().data();
  const Mat3 R_rest = sim.model().skeleton->joints[0].X_PC_rest.R;
  const Mat3 R_true = R_rest * Quat(q[0], q[1], q[2], q[3]).toRotationMatrix();
  const Mat3 R_read = R_rest * Quat(read[0], read[1], read[2], read[3]).toRotationMatrix();
  EXPECT_NEAR((R_read - Eigen::AngleAxisd(angle, Vec3::UnitY()) * R_true).norm(), 0.0, 1e-12);
  EXPECT_EQ(read[4], q[4]);
  EXPECT_EQ(sim.measured_joint_position(1), q[4]);
}

}  // namespace
}  // namespace anthrob
