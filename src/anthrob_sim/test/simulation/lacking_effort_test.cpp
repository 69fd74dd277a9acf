// Inverse dynamics: what a joint lacks to follow an imposed motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "anthrob_sim/simulation.h"
#include "support.h"

namespace anthrob {
namespace {

constexpr double kStep = 1e-3;
constexpr double kMass = 2.0, kArm = 0.3, kInertia = 0.05;  // a pendulum about its hinge
constexpr double kTotal = kInertia + kMass * kArm * kArm;

/// A pendulum that hangs down at 0, with friction and a stop at 0.8 rad.
testing_support::TemporaryRobot pendulum(const std::string& friction) {
  return {R"(<robot name="p"><link name="base"/>
    <joint name="hinge" type="revolute"><parent link="base"/><child link="rod"/>
      <axis xyz="0 1 0"/><limit lower="-0.8" upper="0.8" effort="1" velocity="1"/></joint>
    <link name="rod"><inertial><origin xyz="0 0 -0.3"/><mass value="2.0"/>
      <inertia ixx="0.05" iyy="0.05" izz="0.05" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>)",
          R"(robot: robot.urdf
gravity: [0, 0, -9.81]
joints:
  hinge: {driven: true, friction: )" +
              friction + R"(, stop: {stiffness: 500.0, damping: 0.0}}
)"};
}

/// What a motion A sin(w t) lacks in its last step, after so many.
Simulation::LackingEffort lacking(Simulation& sim, double amplitude, double omega, int steps,
                                  double rest) {
  const auto at = [&](int i) { return amplitude * std::sin(omega * i * kStep); };
  sim.place({at(-2)}, {});
  for (int i = -1; i <= steps; ++i) {
    sim.imposed_posture().impose({at(i)});
    sim.step();
  }
  return sim.lacking_effort(0, rest);
}

TEST(LackingEffort, IsThatOfTheEquationOfMotion) {
  const auto robot = pendulum("{static: 0.6, kinetic: 0.4, viscous: 0.2, stribeck_velocity: 0.1}");
  Simulation sim(robot.load(kStep));
  sim.apply_effort(0, 0.7);
  sim.apply_load(0, -0.1);
  const double omega = 5.0, amplitude = 0.9;
  for (const int steps : {40, 100, 290, 300, 400, 700}) {
    const auto found = lacking(sim, amplitude, omega, steps, 0.01);
    const auto at = [&](int i) { return amplitude * std::sin(omega * i * kStep); };
    const double q = at(steps - 1), speed = (at(steps) - at(steps - 2)) / (2.0 * kStep);
    const double acceleration = (at(steps) - 2.0 * q + at(steps - 2)) / (kStep * kStep);
    const double level = 0.4 + 0.2 * std::exp(-std::abs(speed) / 0.1);
    const double depth = std::abs(at(steps)) - 0.8;
    const double push = std::copysign(500.0 * std::max(0.0, depth), q);
    const double needed = kTotal * acceleration + kMass * kArm * 9.81 * std::sin(q) + 0.2 * speed +
                          std::copysign(level, speed) + push;
    EXPECT_NEAR(found.inertial, kTotal * acceleration, 1e-6);
    EXPECT_NEAR(found.range.low, needed - 0.6, 2e-6) << steps;
    EXPECT_EQ(found.range.low, found.range.high);
  }
}

/// Of an effort, 0.8 acts, and a quarter of that is lost where it drives, gained where it brakes.
TEST(LackingEffort, IsCountedAsEffortThatIsApplied) {
  const auto robot = pendulum("{static: 0.0, kinetic: 0.0, viscous: 0.2, stribeck_velocity: 0.1}");
  LoadOptions options;
  options.step = kStep;
  options.effects = {{"effort_gain", "hinge", {{"gain", 0.8}}},
                     {"joint_effort_friction", "hinge", {{"share", 0.25}}}};
  struct Motion {
    double omega, effort;
    int steps;
  };
  for (const Motion& m : {Motion{5.0, 0.7, 100}, Motion{2.0, 1.0, 1000}}) {
    const auto lacks = [&](double effort) {
      Simulation sim(load_robot_model(robot.file(), options));
      sim.apply_effort(0, effort);
      return lacking(sim, 0.3, m.omega, m.steps, 0.01).range.low;
    };
    const double more = lacks(m.effort);
    EXPECT_GT(std::abs(more), 0.05);
    EXPECT_NEAR(lacks(m.effort + more), 0.0, 1e-9) << m.omega;
  }
}

TEST(LackingEffort, IsARangeWhereStaticFrictionMayHold) {
  const auto robot = pendulum("{static: 0.6, kinetic: 0.4, viscous: 0.0, stribeck_velocity: 0.1}");
  Simulation sim(robot.load(kStep));
  sim.apply_effort(0, 0.25);
  const auto held = lacking(sim, 0.0, 1.0, 3, 0.01);
  EXPECT_NEAR(held.range.low, -0.6 - 0.25, 1e-9);
  EXPECT_NEAR(held.range.high, 0.6 - 0.25, 1e-9);
}

/// A bearing carries weight and inertia of the motion that is imposed on it.
TEST(LackingEffort, KnowsTheLoadOfABearingThatIsMoved) {
  const auto robot = pendulum("{static: 0.0, kinetic: 0.0, viscous: 0.0, stribeck_velocity: 0.1}");
  const double mu = 0.5, radius = 0.1, omega = 5.0, amplitude = 0.7;
  LoadOptions options;
  options.step = kStep;
  options.effects = {{"joint_load_friction", "hinge", {{"mu", mu}, {"radius", radius}}}};
  double least = HUGE_VAL, most = 0.0;
  for (const int steps : {10, 100, 200, 290, 340, 420, 628}) {
    Simulation sim(load_robot_model(robot.file(), options));
    const auto found = lacking(sim, amplitude, omega, steps, 0.0);
    const double phase = omega * (steps - 0.5) * kStep, q = amplitude * std::sin(phase);
    const double speed = amplitude * omega * std::cos(phase), acceleration = -omega * omega * q;
    const double along = kMass * (9.81 * std::cos(q) + kArm * speed * speed),
                 across = kMass * (9.81 * std::sin(q) + kArm * acceleration);
    const double friction = mu * radius * std::hypot(along, across);
    const double needed = kTotal * acceleration + kMass * kArm * 9.81 * std::sin(q);
    EXPECT_NEAR(found.range.low - needed, std::copysign(friction, speed), 0.02) << steps;
    EXPECT_EQ(found.range.low, found.range.high);
    least = std::min(least, friction), most = std::max(most, friction);
  }
  EXPECT_GT(most, 1.3 * least);
}

TEST(LackingEffort, KnowsTheLoadAcrossAGuideThatIsMoved) {
  const double tilt = 0.6, mass = 2.0, mu = 0.3;
  const testing_support::TemporaryRobot robot(
      R"(<robot name="s"><link name="base"/>
    <joint name="slide" type="prismatic"><parent link="base"/><child link="block"/>
      <origin rpy="0 0.6 0"/><axis xyz="1 0 0"/>
      <limit lower="-5" upper="5" effort="1" velocity="1"/></joint>
    <link name="block"><inertial><mass value="2.0"/>
      <inertia ixx="0.05" iyy="0.05" izz="0.05" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>)",
      R"(robot: robot.urdf
gravity: [0, 0, -9.81]
joints:
  slide: {driven: true, stop: {stiffness: 500.0, damping: 0.0}}
)");
  LoadOptions options;
  options.step = kStep;
  options.effects = {{"joint_load_friction", "slide", {{"mu", mu}}}};
  Simulation sim(load_robot_model(robot.file(), options));
  sim.apply_effort(0, 4.0);
  sim.apply_load(0, 1.0);
  const double acceleration = 3.0;
  const auto at = [&](int i) { return 0.5 * acceleration * kStep * kStep * i * i; };
  sim.place({at(0)}, {});
  for (int i = 1; i <= 50; ++i) {
    sim.imposed_posture().impose({at(i)});
    sim.step();
  }
  // Down the slope: neither acceleration nor efforts press it against the guide.
  const double needed = mass * acceleration - mass * 9.81 * std::sin(tilt) +
                        mu * mass * 9.81 * std::cos(tilt) - 4.0 - 1.0;
  EXPECT_NEAR(sim.lacking_effort(0, 1e-6).range.low, needed, 1e-6);
}

TEST(LackingEffort, IsNothingAlongAMotionThatWasSimulated) {
  const auto robot = pendulum("{static: 0.3, kinetic: 0.2, viscous: 0.2, stribeck_velocity: 0.1}");
  const auto effort = [](int i) { return 3.0 * std::sin(0.004 * i); };
  Simulation free(robot.load(kStep));
  std::vector<double> q = {0.0};
  for (int i = 0; i < 2000; ++i) {
    free.apply_effort(0, effort(i));
    free.step();
    q.push_back(free.configuration()[0]);
  }
  Simulation led(robot.load(kStep));
  led.place({q[0]}, {});
  double squares = 0.0;
  for (int i = 0; i < 2000; ++i) {
    led.apply_effort(0, effort(i));
    led.imposed_posture().impose({q[static_cast<std::size_t>(i) + 1]});
    led.step();
    const auto found = led.lacking_effort(0, 1e-6).range;
    const double left = std::max({0.0, found.low, -found.high});
    squares += left * left / 2000;
  }
  EXPECT_LT(std::sqrt(squares), 0.02);
}

TEST(LackingEffort, IsRefusedWhereItIsNotComputed) {
  const auto robot = pendulum("{static: 0.0, kinetic: 0.0, viscous: 0.0, stribeck_velocity: 0.1}");
  Simulation sim(robot.load(kStep));
  EXPECT_THROW(sim.lacking_effort(0, 0.0), BadInput);  // nothing is imposed
  EXPECT_THROW(sim.lacking_effort(1, 0.0), BadInput);
  Simulation arm(load_robot_model(testing_support::config("anthrob/model_I.yaml")));
  arm.imposed_posture().impose(arm.configuration());
  arm.step();
  EXPECT_THROW(arm.lacking_effort(1, 0.0), BadInput);
}

}  // namespace
}  // namespace anthrob
