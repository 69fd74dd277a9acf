// Friction in the running chain: capstan ratios, holding without creep, energy.
#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_sim/simulation.h"
#include "support.h"

namespace anthrob {
namespace {

using testing_support::config;
using testing_support::Random;
using testing_support::TemporaryRobot;

constexpr double kLinkMass = 2.0, kGravity = 9.81, kLinkStatic = 0.195, kLinkKinetic = 0.156;

const char* const kHoistUrdf = R"(<robot name="hoist">
  <link name="world"/>
  <joint name="slide" type="prismatic"><parent link="world"/><child link="load"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="0" velocity="0"/></joint>
  <link name="load"><inertial><mass value="2.0"/>
    <inertia ixx="1e-3" ixy="0" ixz="0" iyy="1e-3" iyz="0" izz="1e-3"/></inertial></link>
</robot>)";

/// A motor winds a tendon over one eyelet, by 90 degrees, and lifts a mass. The spring sits before
/// or behind the eyelet, seen from the motor.
std::string hoist(const std::string& law, int spring_segment, double joint_static = 0.0) {
  return R"(robot: robot.urdf
gravity: [0, 0, -9.81]
joints:
  slide:
    friction: {static: )" +
         std::to_string(joint_static) + ", kinetic: " + std::to_string(0.8 * joint_static) +
         R"(, viscous: 1.0, stribeck_velocity: 0.01}
    stop: {stiffness: 10000, damping: 10}
springs:
  coil: {type: spring_damper, rest_length: 0.0, stiffness: 2000, damping: 20}
actuators:
  winch:
    type: dc_motor
    motor: {resistance: 0.67, inductance: 5.73e-5, torque_constant: 0.0115, back_emf_constant: 0.0115, rotor_inertia: 1.05e-6}
    gear: {law: load_direction, ratio: 128, efficiency: 1.0, inertia: 4.0e-8, friction_torque: 0.0}
    power_stage: {resistance: 0.12}
    nominal_voltage: 12.0
eyelet_friction: )" +
         law + R"(
muscles:
  rope:
    actuator: winch
    spindle_radius: 0.0065
    rest_tendon_length: 0.9
    spring: {kind: coil, segment: )" +
         std::to_string(spring_segment) + R"(}
    force_sensor_segment: 0
    path:
      - {point: [-0.4, 0, 0.5], body: world}
      - {point: [0, 0, 0.5], body: world}
      - {point: [0, 0, 0], body: load}
)";
}

const std::string kSticking =
    "{law: sticking, static: 0.195, kinetic: 0.156, stribeck_velocity: 0.001, presliding: 1.0e-5}";
const std::string kSmooth =
    "{law: smooth_stribeck, static: 0.195, kinetic: 0.156, stribeck_velocity: 0.001, steepness: "
    "10}";

/// Moves the winch at constant tendon speed and returns the tension ratio origin side / insertion
/// side.
double capstan_ratio(const std::string& law, int spring_segment, double speed) {
  const TemporaryRobot robot(kHoistUrdf, hoist(law, spring_segment));
  Simulation sim(robot.load());
  const double lift = kLinkMass * kGravity / 2000.0;
  double position = lift / 0.0065;
  sim.place({0.0}, {position});
  for (int i = 0; i < 4000; ++i) {
    position += speed / 0.0065 * sim.step_length();
    sim.muscle_inputs().impose_position(0, position, speed / 0.0065);
    sim.step();
  }
  return sim.muscle(0).tension(0) / sim.muscle(0).tension(1);
}

TEST(Eyelet, CapstanRatioInBothDirections) {
  const double expected = std::exp(kLinkKinetic * M_PI / 2);
  for (const std::string& law : {kSticking, kSmooth}) {
    for (const int segment : {0, 1}) {
      EXPECT_NEAR(capstan_ratio(law, segment, 0.02), expected, 1e-4 * expected) << law << segment;
      EXPECT_NEAR(capstan_ratio(law, segment, -0.02), 1.0 / expected, 1e-4) << law << segment;
    }
  }
}

TEST(Eyelet, InsertionSideCarriesTheLoad) {
  // Behind the eyelet the tendon carries the weight, whatever friction does before it. (Static
  // friction no larger than kinetic: otherwise the hoist moves by stick and slip.)
  const TemporaryRobot robot(kHoistUrdf, hoist("{law: sticking, static: 0.156, kinetic: 0.156, "
                                               "stribeck_velocity: 0.001, presliding: 1.0e-5}",
                                               0));
  Simulation sim(robot.load());
  double position = kLinkMass * kGravity / 2000.0 / 0.0065;
  sim.place({0.0}, {position});
  for (int i = 0; i < 3000; ++i) {
    sim.muscle_inputs().impose_position(0, position += 2e-3, 2.0);
    sim.step();
  }
  const double viscous = 1.0 * 0.0065 * 2.0;
  EXPECT_NEAR(sim.muscle(0).tension(1), kLinkMass * kGravity + viscous, 1e-3);
  EXPECT_NEAR(sim.muscle(0).tension(0) / sim.muscle(0).tension(1),
              std::exp(kLinkKinetic * M_PI / 2), 1e-6);
}

/// Slackens the spring side to a share of the load and watches the load for a minute.
double creep(const std::string& law, double share) {
  const TemporaryRobot robot(kHoistUrdf, hoist(law, 0));
  Simulation sim(robot.load());
  const double weight = kLinkMass * kGravity;
  const auto hold = [&](double tension, int steps) {
    const double position = tension / 2000.0 / 0.0065;
    for (int i = 0; i < steps; ++i)
      sim.muscle_inputs().impose_position(0, position, 0.0), sim.step();
  };
  sim.place({0.0}, {weight / 2000.0 / 0.0065});
  hold(share * weight, 1000);
  const double before = sim.configuration()[0];
  hold(share * weight, 60000);
  return sim.configuration()[0] - before;
}

TEST(Eyelet, StickingLawHoldsBelowItsLimitForAMinute) {
  const double lowest = std::exp(-kLinkStatic * M_PI / 2);  // share of the load at which it slips
  EXPECT_NEAR(creep(kSticking, 0.5 * (1.0 + lowest)), 0.0, 1e-9);
  EXPECT_NEAR(creep(kSticking, lowest + 0.02), 0.0, 1e-9);
}

TEST(Eyelet, SmoothLawOfTheThesisCreeps) {
  // The reason for the other law: the smooth one cannot hold anything at rest.
  EXPECT_LT(creep(kSmooth, 0.87), -1e-4);
}

TEST(Eyelet, SlipsBeyondItsLimit) {
  // The load sinks until the spring side carries its share again.
  const TemporaryRobot robot(kHoistUrdf, hoist(kSticking, 0));
  Simulation sim(robot.load());
  const double weight = kLinkMass * kGravity, lowest = std::exp(-kLinkStatic * M_PI / 2);
  sim.place({0.0}, {weight / 2000.0 / 0.0065});
  const double position = (lowest - 0.1) * weight / 2000.0 / 0.0065;
  for (int i = 0; i < 3000; ++i) sim.muscle_inputs().impose_position(0, position, 0.0), sim.step();
  EXPECT_LT(sim.configuration()[0], -1e-4);
  EXPECT_GT(sim.muscle(0).tension(0), lowest * sim.muscle(0).tension(1));
}

TEST(Joint, StaticFrictionHoldsBelowItsLimitForAMinute) {
  const TemporaryRobot robot(kHoistUrdf, hoist("{law: none}", 0, 25.0));
  Simulation sim(robot.load());  // weight 19.6 N, friction 25 N, no tendon tension
  sim.step(1000);
  const double before = sim.configuration()[0];
  sim.step(60000);
  EXPECT_NEAR(sim.configuration()[0], before, 1e-12);
  EXPECT_NEAR(before, 0.0, 1e-9);
  sim.apply_load(0, -6.0);  // beyond the limit
  sim.step(500);
  EXPECT_LT(sim.configuration()[0], -1e-3);
}

TEST(Joint, StaticFrictionHoldsAgainstATendonThatPullsHarderAndHarder) {
  // Weight 19.6 N, friction 25 N, the tendon to 30 N, over an eyelet without friction.
  for (const int segment : {0, 1}) {
    const TemporaryRobot robot(kHoistUrdf, hoist("{law: none}", segment, 25.0));
    Simulation sim(robot.load());
    sim.step(1000);
    const double before = sim.configuration()[0];
    const double speed = 30.0 / 2000.0 / 0.0065;
    for (int i = 1; i <= 1000; ++i) {
      sim.muscle_inputs().impose_position(0, 1e-3 * i * speed, speed);
      sim.step();
    }
    EXPECT_GT(sim.muscle(0).spring_tension(), 29.0) << segment;
    EXPECT_NEAR(sim.configuration()[0], before, 1e-9) << segment;
  }
}

TEST(Joint, StribeckFrictionAtConstantSpeed) {
  // Terminal speed: load - weight = kinetic + (static - kinetic) exp(-v / v_s) + viscous v.
  const TemporaryRobot robot(kHoistUrdf, hoist("{law: none}", 0, 25.0));
  Simulation sim(robot.load());
  sim.apply_load(0, kLinkMass * kGravity + 26.0);
  sim.step(20000 / 40);
  double speed = 0.0;
  for (int i = 0; i < 100; ++i) {
    sim.step();
    const double v = sim.tree().velocities()[0];
    // m a = load - weight - friction, within the first-order phase of the velocity.
    const double friction = 20.0 + 5.0 * std::exp(-v / 0.01) + 1.0 * v;
    if (i > 0) {
      EXPECT_NEAR((v - speed) / 1e-3 * kLinkMass, 26.0 - friction, 0.05);
    }
    speed = v;
  }
}

TEST(Joint, BallJointFrictionIsIsotropic) {
  // The same torque about any axis: held below the limit, moving above it.
  const char* const urdf = R"(<robot name="ball"><link name="world"/>
    <joint name="ball" type="floating"><parent link="world"/><child link="body"/></joint>
    <link name="body"><inertial><mass value="1"/>
    <inertia ixx="1e-2" ixy="0" ixz="0" iyy="1.2e-2" iyz="0" izz="0.9e-2"/></inertial></link></robot>)";
  const auto model = [](const Vec3& center) {
    return "robot: robot.urdf\ngravity: [0, 0, -9.81]\njoints: {ball: {type: ball, center: [" +
           std::to_string(center[0]) + ", " + std::to_string(center[1]) + ", " +
           std::to_string(center[2]) +
           "], friction: {static: 0.3, kinetic: 0.2, viscous: 0.01, stribeck_velocity: 0.05}}}\n";
  };
  Random random(11);
  for (int i = 0; i < 20; ++i) {
    const double heading = random.uniform(0.0, 6.28);
    const Vec3 across(std::cos(heading), std::sin(heading), 0.0);
    const double limit = 0.3 / 9.81;  // lever at which the weight reaches the static torque
    for (const double share : {0.98, 1.02}) {
      const TemporaryRobot robot(urdf, model(share * limit * across));
      Simulation sim(robot.load());
      sim.step(3000);
      const auto& q = sim.configuration();
      const double turned = angular_distance(Quat(q[0], q[1], q[2], q[3]), Quat::Identity());
      if (share < 1.0) {
        EXPECT_LT(turned, 1e-9);
      } else {
        EXPECT_GT(turned, 1e-2);
      }
    }
  }
}

/// Energy of skeleton and rings.
double mechanical_energy(const Simulation& sim) {
  double sum = audit_energy(sim).kinetic + audit_energy(sim).potential;
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) sum += sim.muscle(m).spring_energy();
  return sum;
}

/// The arm is let go in a random posture with tense muscles and its motors held still. What the
/// mechanical energy loses beyond joints, stops and rings is eyelet friction's.
void expect_friction_dissipates(const std::string& law, int runs) {
  const double step = 1e-4;
  const auto model = [&] {
    ConfigNode config_node = ConfigNode::load(config("anthrob/model_I.yaml"));
    std::string text = config_node.to_yaml();
    const auto at = text.find("eyelet_friction:");
    const auto end = text.find("\nmuscles:", at);
    text.replace(at, end - at, "eyelet_friction: " + law);
    return build_robot_model(ConfigNode::parse(text, config("anthrob/model_I.yaml")), {step, {}});
  }();
  Random random(23);
  double total_loss = 0.0, total_power = 0.0;
  for (int run = 0; run < runs; ++run) {
    Simulation sim(model);
    std::vector<double> positions(11);
    for (double& p : positions) p = random.uniform(0.0, 1.0);
    sim.place(testing_support::random_posture(random), positions);
    for (int m = 0; m < 11; ++m) sim.muscle_inputs().impose_position(m, positions[m], 0.0);
    const double start = mechanical_energy(sim);
    double elsewhere = 0.0, friction = 0.0, turned_over = 0.0, last = audit_energy(sim).kinetic;
    for (int i = 0; i < 500; ++i) {
      sim.step();
      elsewhere += sim.last_step().joint_dissipation * step;
      for (int m = 0; m < 11; ++m) {
        elsewhere += sim.muscle(m).spring_dissipation() * step;
        friction += sim.muscle(m).friction_power() * step;
      }
      turned_over += std::abs(audit_energy(sim).kinetic - last);
      last = audit_energy(sim).kinetic;
    }
    const double loss = start - mechanical_energy(sim) - elsewhere;
    const double tolerance = 0.01 * turned_over + 1e-4;
    ASSERT_GT(friction, -1e-4) << "run " << run;
    ASSERT_GT(loss, -tolerance) << "run " << run;
    ASSERT_NEAR(loss, friction, tolerance) << "run " << run;
    total_loss += loss;
    total_power += friction;
  }
  EXPECT_GT(total_power, 0.01 * runs);  // [J]
  EXPECT_NEAR(total_loss, total_power, 0.02 * total_power);
}

TEST(Friction, SmoothLawNeverAddsEnergyInRandomRuns) {
  expect_friction_dissipates(kSmooth, 500);
}
TEST(Friction, StickingLawNeverAddsEnergyInRandomRuns) {
  expect_friction_dissipates(kSticking, 500);
}

const char* const kPulleyUrdf = R"(<robot name="pulley">
  <link name="world"/>
  <joint name="hinge" type="continuous"><parent link="world"/><child link="arm"/>
    <origin xyz="0.31 0.17 0.53" rpy="0.3 -0.8 1.1"/><axis xyz="0.48 0.6 0.64"/></joint>
  <link name="arm"><inertial><mass value="0.5"/><origin xyz="0.1 0 0"/>
    <inertia ixx="1e-3" ixy="0" ixz="0" iyy="1e-3" iyz="0" izz="1e-3"/></inertial></link>
</robot>)";

/// Two eyelets of different bodies in one place, on the hinge's axis: the tendon turns there by
/// what the pieces beside them turn, whatever rounding says about the piece between them.
TEST(FrictionChain, APieceWithoutLengthHasNoTurningOfItsOwn) {
  std::string text = hoist(kSmooth, 0);
  const auto path = text.find("    path:");
  text = text.substr(0, path) +
         "    path:\n"
         "      - {point: [-0.4, 0.1, 0.5], body: world}\n"
         "      - {point: [0.31, 0.17, 0.53], body: world}\n"
         "      - {point: [0, 0, 0], body: arm}\n"
         "      - {point: [0.2, 0.05, 0.1], body: arm}\n";
  const auto joint = text.find("  slide:"), springs = text.find("springs:");
  text = text.substr(0, joint) +
         "  hinge:\n    friction: {static: 0, kinetic: 0, viscous: 0.01, stribeck_velocity: 1}\n" +
         text.substr(springs);
  const TemporaryRobot robot(kPulleyUrdf, text);
  Simulation sim(robot.load());
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    sim.place({random.uniform(-3.0, 3.0)}, {0.0});
    const MusclePath& path_now = sim.muscle(0).path();
    ASSERT_LT(path_now.segments()[1].length, 1e-9);
    const Vec3 in = path_now.segments()[0].direction_W, out = path_now.segments()[2].direction_W;
    EXPECT_NEAR(path_now.obstacles()[1].turning + path_now.obstacles()[2].turning,
                std::acos(in.dot(out)), 1e-7);
    EXPECT_EQ(path_now.segments()[1].direction_W, in);
  }
}

}  // namespace
}  // namespace anthrob
