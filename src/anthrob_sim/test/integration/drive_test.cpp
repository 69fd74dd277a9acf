// Drives on joints against closed forms of motor, shaft and pendulum.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <unsupported/Eigen/MatrixFunctions>

#include "anthrob_core/errors.h"
#include "anthrob_sim/simulation.h"
#include "anthrob_sim/statics/equilibrium.h"
#include "support.h"

namespace anthrob::drives {
namespace {

constexpr double kMass = 2.0, kArm = 0.3, kOwn = 0.05;
constexpr double kInertia = kOwn + kMass * kArm * kArm;  // about the hinge [kg m^2]
// The motor: 12 V, gear of 50, beyond which the transmission turns twice as fast as the joint.
constexpr double kOhm = 2.0, kHenry = 1e-3, kConstant = 0.02, kRotor = 4e-6, kGear = 50.0,
                 kBelt = 2.0;
constexpr double kTotalRatio = kGear * kBelt;
constexpr double kReflected = kRotor * kTotalRatio * kTotalRatio;  // at the joint [kg m^2]

struct Bench {
  double gravity = 0.0;
  std::string transmission = "{ratio: 2.0}";
  double constant = kConstant, friction = 0.0, efficiency = 1.0;
  std::string joint = "hinge";
  std::string more = "";
};

std::string urdf(const std::string& kind) {
  const std::string type = kind == "hinge" ? "continuous" : "prismatic";
  const std::string limit =
      kind == "hinge" ? "" : R"(<limit lower="-9" upper="9" effort="1" velocity="1"/>)";
  return R"(<robot name="p"><link name="base"/>
    <joint name="axis" type=")" +
         type + R"("><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/>)" + limit +
         R"(</joint>
    <link name="rod"><inertial><origin xyz="0 0 -0.3"/><mass value="2.0"/>
      <inertia ixx="0.05" iyy="0.05" izz="0.05" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>)";
}

testing_support::TemporaryRobot robot_of(const Bench& bench) {
  const auto text = [](double x) { return std::to_string(x); };
  const std::string stop = bench.joint == "hinge" ? "" : "stop: {stiffness: 1e5, damping: 0.0}, ";
  return {urdf(bench.joint), R"(robot: robot.urdf
gravity: [0, 0, -)" + text(bench.gravity) +
                                 R"(]
actuators:
  motor:
    type: dc_motor
    motor: {resistance: 2.0, inductance: 1e-3, torque_constant: )" +
                                 text(bench.constant) + R"(, back_emf_constant: )" +
                                 text(bench.constant) +
                                 R"(, rotor_inertia: 4e-6}
    gear: {law: load_direction, ratio: 50.0, efficiency: )" +
                                 text(bench.efficiency) + R"(, inertia: 0.0, friction_torque: )" +
                                 text(bench.friction) +
                                 R"(}
    power_stage: {resistance: 0.0}
    nominal_voltage: 12.0
controllers:
  pd:
    period: 0.001
    voltage_limit: 12.0
    limits: {position: 30.0, current: 6.0, force: 50.0}
    position: {proportional: 20.0, derivative: 0.5, force_feedforward: 0.0}
    current: {proportional: 0.0, integral: 500.0}
    force: {proportional: 0.1, integral: 5.0, derivative: 0.1, force_feedforward: 0.05}
joints:
  axis: {)" + stop + "drive: {actuator: motor, controller: pd, transmission: " +
                                 bench.transmission + "}" + bench.more + "}\n"};
}

/// Speeds at the joint after a step of the voltage: motor and joint as one linear equation.
/// @param stiffness of the shaft; infinite: rigid
/// @return speed of the joint
double linear_speed(double volts, double time, double stiffness) {
  // current, speed of the motor and of the joint at the joint, twist
  Eigen::Matrix<double, 5, 5> A = Eigen::Matrix<double, 5, 5>::Zero();
  const double k = kConstant * kTotalRatio;
  A(0, 0) = -kOhm / kHenry;
  A(0, 1) = -k / kHenry;
  A(0, 4) = volts / kHenry;
  if (std::isinf(stiffness)) {
    A(1, 0) = k / (kReflected + kInertia);
    return ((A * time).exp())(1, 4);
  }
  A(1, 0) = k / kReflected;
  A(1, 3) = -stiffness / kReflected;
  A(2, 3) = stiffness / kInertia;
  A(3, 1) = 1.0;
  A(3, 2) = -1.0;
  return ((A * time).exp())(2, 4);
}

TEST(Drive, RunsUpAsMotorAndJointTogether) {
  for (const double stiffness : {HUGE_VAL, 1e7, 2e4, 200.0, 20.0}) {
    Bench bench;
    if (std::isfinite(stiffness)) {
      bench.transmission = "{ratio: 2.0, stiffness: " + std::to_string(stiffness) + "}";
    }
    const auto robot = robot_of(bench);
    Simulation sim(robot.load());
    ASSERT_EQ(sim.muscle(0).model().name, "axis_drive");
    sim.command(0, ecu::Mode::kVoltage, 6.0);
    for (int i = 1; i <= 1500; ++i) {
      sim.step();
      if (i % 50 != 0) continue;
      // A step is 1 ms: explicit integration is right to half of that.
      const double here = linear_speed(6.0, i * 1e-3, stiffness);
      const double slope = linear_speed(6.0, i * 1e-3 + 5e-4, stiffness) -
                           linear_speed(6.0, i * 1e-3 - 5e-4, stiffness);
      EXPECT_NEAR(sim.read_velocity(0), here, 0.6 * std::abs(slope) + 0.01)
          << stiffness << " " << i;
      if (std::isfinite(stiffness)) continue;
      EXPECT_NEAR(sim.reading(0).position, kBelt * sim.measured_joint_position(0), 1e-3);
    }
    EXPECT_NEAR(sim.read_velocity(0), 6.0 / (kConstant * kTotalRatio), 0.05);
    EXPECT_GT(sim.configuration()[0], 3.0) << "whole turns are counted";
  }
}

/// Time between crossings of zero upwards.
double period_of(Simulation& sim, int steps) {
  double first = -1.0, last = -1.0, before = sim.configuration()[0];
  int count = 0;
  for (int i = 1; i <= steps; ++i) {
    sim.step();
    const double now = sim.configuration()[0];
    if (before < 0.0 && now >= 0.0) {
      last = i - now / (now - before);
      if (first < 0.0)
        first = last;
      else
        ++count;
    }
    before = now;
  }
  return 1e-3 * (last - first) / count;
}

TEST(Drive, RotorIsFeltAtTheJoint) {
  Bench bench;
  bench.gravity = 9.81;
  bench.constant = 1e-6;  // as with open terminals
  const auto robot = robot_of(bench);
  Simulation sim(robot.load());
  sim.place({0.05}, {0.0});
  EXPECT_NEAR(sim.reading(0).position, kBelt * 0.05, 1e-9) << "a rigid drive stands at its joint";
  const double expected = 2.0 * M_PI * std::sqrt((kInertia + kReflected) / (kMass * kArm * 9.81)) *
                          (1.0 + 0.05 * 0.05 / 16.0);
  EXPECT_NEAR(period_of(sim, 20000), expected, 1e-4 * expected);
  double largest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    sim.step();
    largest = std::max(largest, sim.configuration()[0]);
  }
  EXPECT_NEAR(largest, 0.05, 1e-4) << "after 22 s without loss";
}

TEST(Drive, ElasticShaftVibratesWithoutLoss) {
  Bench bench;
  bench.constant = 1e-6;
  bench.transmission = "{ratio: 2.0, stiffness: 40.0}";
  const auto robot = robot_of(bench);
  Simulation sim(robot.load());
  const double twist = 0.02;
  sim.place({0.0}, {kBelt * twist});
  EXPECT_NEAR(sim.muscle(0).force(), 40.0 * twist, 1e-12);
  const double omega = std::sqrt(40.0 * (1.0 / kInertia + 1.0 / kReflected));
  double largest = 0.0;
  for (int i = 1; i <= 20000; ++i) {
    sim.step();
    if (i > 19000) largest = std::max(largest, std::abs(sim.muscle(0).expansion()));
    if (i > 300) continue;
    EXPECT_NEAR(sim.muscle(0).expansion(), twist * std::cos(omega * i * 1e-3), 0.03 * twist) << i;
  }
  EXPECT_NEAR(largest, twist, 0.02 * twist) << "after 20 s";
}

TEST(Drive, GearFrictionHoldsThePendulum) {
  Bench bench;
  bench.gravity = 9.81;
  bench.friction = 1.05 * kMass * kArm * 9.81 * std::sin(0.4) / kTotalRatio;
  const auto robot = robot_of(bench);
  for (const double angle : {0.4, 0.5}) {
    Simulation sim(robot.load());
    sim.place({angle}, {0.0});
    sim.step(2000);
    if (angle == 0.4) {
      EXPECT_NEAR(sim.configuration()[0], angle, 1e-5);
      const double there = sim.configuration()[0];
      sim.step(10000);
      EXPECT_NEAR(sim.configuration()[0], there, 1e-8) << "creeps";
      EXPECT_NEAR(sim.muscle(0).force(), kMass * kArm * 9.81 * std::sin(angle), 1e-3);
    } else {
      EXPECT_LT(sim.configuration()[0], std::asin(1.05 * std::sin(0.4))) << "runs down";
    }
  }
}

TEST(Drive, FrictionOfItsMotorTakesItsCurrent) {
  const double friction = 2e-3, volts = 6.0;
  for (const char* transmission : {"{ratio: 2.0}", "{ratio: 2.0, stiffness: 200.0}"}) {
    Bench bench;
    bench.transmission = transmission;
    const auto robot = robot_of(bench);
    LoadOptions options;
    options.effects = {{"motor_friction", "axis_drive", {{"torque", friction}}}};
    Simulation sim(load_robot_model(robot.file(), options));
    sim.command(0, ecu::Mode::kVoltage, volts);
    sim.step(6000);
    const double current = friction / kConstant;
    EXPECT_NEAR(sim.muscle(0).actuator().current, current, 2e-3 * current) << transmission;
    const double speed = (volts - kOhm * current) / (kConstant * kTotalRatio);
    EXPECT_NEAR(sim.read_velocity(0), speed, 2e-3 * speed) << transmission;
  }
}

TEST(Drive, ControllersFollowReferencesOfEitherSign) {
  Bench bench;
  bench.gravity = 9.81;
  const auto robot = robot_of(bench);
  Simulation sim(robot.load());
  for (const double reference : {0.6, -0.8}) {
    sim.command(0, ecu::Mode::kPosition, reference);
    sim.step(3000);
    const double hold = kMass * kArm * 9.81 * std::sin(sim.configuration()[0]);
    const double volts = hold / (kConstant * kTotalRatio) * kOhm;
    EXPECT_NEAR(kBelt * sim.configuration()[0], reference - volts / 20.0, 1e-4);
    EXPECT_NEAR(sim.muscle(0).measured().force, hold, 1e-3) << "torque of either sign";
  }
  sim.command(0, ecu::Mode::kForce, -1.5);
  sim.step(20000);
  EXPECT_NEAR(sim.muscle(0).force(), -1.5, 1e-3);
  EXPECT_NEAR(kMass * kArm * 9.81 * std::sin(sim.configuration()[0]), -1.5, 2e-3);
}

TEST(Drive, HoldsAPostureAsStaticsSays) {
  Bench bench;
  bench.gravity = 9.81;
  bench.efficiency = 0.8;
  for (const char* transmission : {"{ratio: 2.0}", "{ratio: 2.0, stiffness: 100.0}"}) {
    bench.transmission = transmission;
    const auto robot = robot_of(bench);
    Simulation sim(robot.load());
    const Equilibrium found = find_equilibrium(sim, {-0.7});
    EXPECT_NEAR(found.tension[0], -kMass * kArm * 9.81 * std::sin(0.7), 1e-6);
    sim.place({-0.7}, found.position);
    sim.command(0, ecu::Mode::kPosition, found.reference[0]);
    sim.step(4000);
    EXPECT_NEAR(sim.configuration()[0], -0.7, 2e-3) << transmission;
  }
}

TEST(Drive, PlayLetsTheJointLagBehind) {
  Bench bench;
  const auto robot = robot_of(bench);
  const auto model = load_robot_model(
      robot.file(), {1e-3, {}, {{"gear_backlash", "axis_drive", {{"width", 0.1}}}}});
  Simulation sim(model);
  sim.command(0, ecu::Mode::kPosition, 1.0);
  sim.step(6000);
  const double play = 0.1 / kBelt;  // at the joint
  EXPECT_LE(std::abs(sim.muscle(0).expansion()), 0.5 * play + 1e-3);
  const double reached = sim.configuration()[0];
  EXPECT_NEAR(reached, 0.5, 0.5 * play + 0.01);
  sim.command(0, ecu::Mode::kPosition, 1.0 - 0.4 * 0.1);
  sim.step(3000);
  EXPECT_NEAR(sim.muscle(0).force(), 0.0, 1e-9) << "between the flanks";
}

TEST(Drive, MovesASlide) {
  Bench bench;
  bench.joint = "slide";
  bench.transmission = "{ratio: 100.0}";
  const auto robot = robot_of(bench);
  Simulation sim(robot.load());
  sim.command(0, ecu::Mode::kVoltage, 6.0);
  sim.step(4000);
  EXPECT_NEAR(sim.read_velocity(0), 6.0 / (kConstant * kGear * 100.0), 1e-3);
}

TEST(Drive, FollowsWhatIsImposed) {
  const auto robot = robot_of({});
  Simulation sim(robot.load());
  // The motor is moved: the joint follows.
  for (int i = 1; i <= 1000; ++i) {
    const double t = i * 1e-3;
    sim.muscle_inputs().impose_position(0, kBelt * 0.3 * (1.0 - std::cos(4.0 * t)),
                                        kBelt * 1.2 * std::sin(4.0 * t));
    sim.step();
    EXPECT_NEAR(sim.configuration()[0], 0.3 * (1.0 - std::cos(4.0 * t)), 2e-3);
  }
  // The joint is moved: the motor follows, and the torque is that of its rotor.
  Simulation led(robot.load());
  led.place({0.0}, {0.0});
  for (int i = 1; i <= 1000; ++i) {
    const double t = i * 1e-3;
    led.imposed_posture().impose({0.3 * (1.0 - std::cos(4.0 * t))});
    led.step();
    EXPECT_NEAR(led.reading(0).position, kBelt * led.configuration()[0], 5e-3);
  }
}

TEST(Drive, SnapshotsGiveTheSameBits) {
  Bench bench;
  bench.gravity = 9.81;
  bench.friction = 1e-3;
  bench.transmission = "{ratio: 2.0, stiffness: 500.0, damping: 0.1}";
  const auto robot = robot_of(bench);
  Simulation sim(robot.load());
  sim.command(0, ecu::Mode::kPosition, 3.0);
  sim.step(300);
  const Snapshot kept = sim.snapshot();
  sim.step(500);
  const double first = sim.configuration()[0];
  sim.restore(kept);
  sim.step(500);
  EXPECT_EQ(sim.configuration()[0], first);
}

constexpr double kLink = 0.4;  // from shoulder to elbow

/// Accelerations of two links of the bench's mass that hang from one another, angles between them,
/// with rotors that are felt at the joints: Lagrange's equations.
Eigen::Vector2d acceleration(const Eigen::Vector2d& q, const Eigen::Vector2d& u, double rotor) {
  const double cosine = std::cos(q[1]), sine = std::sin(q[1]), coupling = kMass * kLink * kArm;
  Eigen::Matrix2d M;
  M << kInertia + kMass * kLink * kLink + kInertia + 2.0 * coupling * cosine + rotor,
      kInertia + coupling * cosine, kInertia + coupling * cosine, kInertia + rotor;
  const double g = 9.81, both = std::sin(q[0] + q[1]);
  const Eigen::Vector2d bias(-coupling * sine * (2.0 * u[0] * u[1] + u[1] * u[1]) +
                                 g * (kMass * kArm * std::sin(q[0]) +
                                      kMass * kLink * std::sin(q[0]) + kMass * kArm * both),
                             coupling * sine * u[0] * u[0] + g * kMass * kArm * both);
  return -M.ldlt().solve(bias);
}

TEST(Drive, TwoOnAnArmFeelEachOther) {
  const std::string body = R"(<inertial><origin xyz="0 0 -0.3"/><mass value="2.0"/>
      <inertia ixx="0.05" iyy="0.05" izz="0.05" ixy="0" ixz="0" iyz="0"/></inertial>)";
  const testing_support::TemporaryRobot robot(
      R"(<robot name="p"><link name="base"/>
    <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/>
      <axis xyz="0 1 0"/></joint><link name="upper">)" +
          body + R"(</link>
    <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/>
      <origin xyz="0 0 -0.4"/><axis xyz="0 1 0"/></joint><link name="lower">)" +
          body + "</link></robot>",
      R"(robot: robot.urdf
gravity: [0, 0, -9.81]
actuators:
  motor:
    type: dc_motor
    motor: {resistance: 2.0, inductance: 1e-3, torque_constant: 1e-9, back_emf_constant: 1e-9, rotor_inertia: 4e-6}
    gear: {law: load_direction, ratio: 100.0, efficiency: 1.0, inertia: 0.0, friction_torque: 0.0}
    power_stage: {resistance: 0.0}
    nominal_voltage: 12.0
joints: {shoulder: {drive: {actuator: motor}}, elbow: {drive: {actuator: motor}}}
)");
  const double rotor = 4e-6 * 1e4, h = 1e-4;
  Simulation sim(robot.load(h));
  Eigen::Vector2d q(0.7, -0.4), u = Eigen::Vector2d::Zero();
  sim.place({q[0], q[1]}, {0.0, 0.0});
  for (int i = 1; i <= 20000; ++i) {
    // Runge and Kutta, fourth order.
    const Eigen::Vector2d a1 = acceleration(q, u, rotor), u2 = u + 0.5 * h * a1;
    const Eigen::Vector2d a2 = acceleration(q + 0.5 * h * u, u2, rotor), u3 = u + 0.5 * h * a2;
    const Eigen::Vector2d a3 = acceleration(q + 0.5 * h * u2, u3, rotor), u4 = u + h * a3;
    const Eigen::Vector2d a4 = acceleration(q + h * u3, u4, rotor);
    q += h / 6.0 * (u + 2.0 * u2 + 2.0 * u3 + u4);
    u += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    sim.step();
    if (i % 500 != 0) continue;
    EXPECT_NEAR(sim.configuration()[0], q[0], 3e-3) << i;
    EXPECT_NEAR(sim.configuration()[1], q[1], 3e-3) << i;
  }
}

/// Motors from light to heavy, gears that stick, shafts of any stiffness, play: what is random here
/// moves no faster than voltage and gravity can make it.
TEST(Drive, AnyDriveStaysWithinItsMeans) {
  testing_support::Random random(4);
  const auto among = [&](double low, double high) {
    return std::exp(random.uniform(std::log(low), std::log(high)));
  };
  const auto maybe = [&](double value) { return random.uniform(0.0, 1.0) < 0.5 ? 0.0 : value; };
  for (int n = 0; n < 60; ++n) {
    const double torque = kMass * kArm * 9.81 * random.uniform(0.1, 3.0), ratio = among(1.0, 300.0);
    const double rotor = kInertia * among(1e-4, 100.0) / (ratio * ratio);
    std::ostringstream model;
    model << "robot: robot.urdf\ngravity: [0, 0, -9.81]\n"
          << "actuators: {motor: {type: dc_motor, motor: {resistance: " << 0.12 * ratio / torque
          << ", inductance: " << 1.2e-5 * ratio / torque
          << ", torque_constant: 0.01, back_emf_constant: 0.01, rotor_inertia: " << rotor
          << "}, gear: {law: load_direction, ratio: " << ratio
          << ", efficiency: " << random.uniform(0.4, 1.0)
          << ", inertia: 0.0, friction_torque: " << maybe(torque / ratio * random.uniform(0.0, 1.0))
          << "}, power_stage: {resistance: 0.0}, nominal_voltage: 12.0}}\n"
          << "joints: {axis: {friction: {static: " << 0.3 * torque
          << ", kinetic: " << maybe(0.2 * torque) << ", viscous: 0.01, stribeck_velocity: 0.05}, "
          << "drive: {actuator: motor";
    if (n % 2 == 0) model << ", transmission: {stiffness: " << torque * among(0.1, 1e6) << "}";
    model << "}}}\n";
    const testing_support::TemporaryRobot robot(urdf("hinge"), model.str());
    LoadOptions options;
    if (n % 3 == 0) {
      options.effects = {{"gear_backlash", "axis_drive", {{"width", random.uniform(1e-3, 0.1)}}}};
    }
    Simulation sim(load_robot_model(robot.file(), options));
    const double fastest = 12.0 / (0.01 * ratio) + std::sqrt(4.0 * kMass * kArm * 9.81 / kInertia);
    for (int i = 0; i < 2000; ++i) {
      if (i % 500 == 0) sim.command(0, ecu::Mode::kVoltage, random.uniform(-12.0, 12.0));
      sim.step();
      ASSERT_LT(std::abs(sim.read_velocity(0)), 1.5 * fastest + 3.0) << n << " " << i;
    }
  }
}

void expect_refused(Bench bench, const std::string& part) {
  const auto robot = robot_of(bench);
  try {
    robot.load();
    ADD_FAILURE() << "accepted: " << part;
  } catch (const BadInput& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

TEST(Drive, BadEntriesAreNamed) {
  Bench bench;
  bench.more = ", driven: true";
  expect_refused(bench, "expected either 'drive'");
  bench = {};
  bench.transmission = "{ratio: 2.0, damping: 0.1}";
  expect_refused(bench, "without 'stiffness' is rigid");
  bench.transmission = "{ratio: -2.0}";
  expect_refused(bench, "ratio");
  bench.transmission = "{ratoi: 2.0}";
  expect_refused(bench, "ratoi");
}

}  // namespace
}  // namespace anthrob::drives
