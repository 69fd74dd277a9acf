// Effects on driven hinges and slides, each against its closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "effects_support.h"

namespace anthrob {
namespace {

using namespace testing_support;

constexpr double kInertia = 0.01;  // of the spinner [kg m^2]

/// A driven shaft without friction, or a carriage of 2 kg on a level guide.
class JointBench {
 public:
  explicit JointBench(bool slides = false)
      : robot_(std::string("<robot name=\"s\"><link name=\"world\"/><joint name=\"axis\" type=\"") +
                   (slides ? "prismatic" : "continuous") +
                   "\"><parent link=\"world\"/><child link=\"rotor\"/><axis xyz=\"" +
                   (slides ? "1 0 0" : "0 0 1") + "\"/>" +
                   (slides ? "<limit lower=\"-100\" upper=\"100\" effort=\"0\" velocity=\"0\"/>"
                           : "") +
                   "</joint><link name=\"rotor\"><inertial><mass value=\"2\"/><inertia "
                   "ixx=\"0.01\" ixy=\"0\" ixz=\"0\" iyy=\"0.01\" iyz=\"0\" "
                   "izz=\"0.01\"/></inertial></link></robot>",
               std::string("robot: robot.urdf\ngravity: [0, 0, -9.81]\njoints:\n  axis:\n"
                           "    driven: true\n    friction: {static: 0, kinetic: 0, viscous: 0, "
                           "stribeck_velocity: 0.05}\n") +
                   (slides ? "    stop: {stiffness: 1e5, damping: 1e2}\n" : "")) {}

  std::shared_ptr<const RobotModel> with(const EffectInstance& effect, double step = kStep) const {
    LoadOptions options;
    options.step = step;
    options.effects = {effect};
    return load_robot_model(robot_.file(), options);
  }
  /// Speed after a time under a constant effort, from rest.
  double speed(const EffectInstance& effect, double effort, double seconds) const {
    Simulation sim(with(effect));
    sim.apply_effort(0, effort);
    sim.step(static_cast<int>(std::lround(seconds / kStep)));
    return sim.tree().velocities()[0];
  }

 private:
  TemporaryRobot robot_;
};

TEST(JointQuadraticDrag, ComesToItsTerminalSpeedAsTheClosedFormSays) {
  const JointBench bench;
  const double drag = 0.004, torque = 0.1, seconds = 0.4;
  // w = sqrt(T / c) tanh(t sqrt(T c) / I)
  const double expected =
      std::sqrt(torque / drag) * std::tanh(seconds * std::sqrt(torque * drag) / kInertia);
  const EffectInstance effect = {"joint_quadratic_drag", "axis", {{"drag", drag}}};
  EXPECT_NEAR(bench.speed(effect, torque, seconds), expected, 2e-3 * expected);
  EXPECT_NEAR(bench.speed(effect, -torque, seconds), -expected, 2e-3 * expected);
  // However large, it does not turn a motion round.
  Simulation sim(bench.with({"joint_quadratic_drag", "axis", {{"drag", 10.0}}}));
  sim.apply_effort(0, 1e4);
  sim.step();
  sim.apply_effort(0, 0.0);
  for (int i = 0; i < 100; ++i) {
    sim.step();
    EXPECT_GT(sim.tree().velocities()[0], 0.0);
  }
}

TEST(JointRipple, IsTheSeriesAndTheSlopeOfItsEnergy) {
  for (const bool slides : {false, true}) {
    const auto robot = JointBench(slides).with({"joint_ripple",
                                                "axis",
                                                {{"periods_1", 7.0},
                                                 {"sine_1", 0.3},
                                                 {"cosine_1", -0.2},
                                                 {"periods_4", 12.0},
                                                 {"cosine_4", 0.1}}});
    const JointTorque& ripple = *robot->joint_torques.at(0);
    Simulation sim(robot);
    const double per_period = slides ? 2.0 * M_PI : 1.0;
    for (double q = -0.4; q < 0.5; q += 0.13) {
      sim.place({q}, {});
      double tau = 0.0;
      ripple.add(sim.tree(), {q}, &tau);
      const double phase = per_period * q;
      EXPECT_NEAR(
          tau,
          0.3 * std::sin(7.0 * phase) - 0.2 * std::cos(7.0 * phase) + 0.1 * std::cos(12.0 * phase),
          1e-12);
      EXPECT_NEAR(tau, -(ripple.energy({q + 1e-5}) - ripple.energy({q - 1e-5})) / 2e-5, 1e-7);
    }
  }
}

TEST(JointRipple, ConservesEnergyAndAveragesOutAtSpeed) {
  const JointBench bench;
  const EffectInstance effect = {
      "joint_ripple", "axis", {{"periods_1", 12.0}, {"sine_1", 0.01}, {"cosine_1", 0.005}}};
  for (const double speed : {0.5, 3.0, 200.0}) {
    Simulation sim(bench.with(effect));
    sim.apply_effort(0, kInertia * speed / kStep);
    sim.step();
    sim.apply_effort(0, 0.0);
    const double start = audit_energy(sim).kinetic + audit_energy(sim).potential;
    double most = 0.0;
    for (int i = 0; i < 3000; ++i) {
      sim.step();
      most =
          std::max(most, std::abs(audit_energy(sim).kinetic + audit_energy(sim).potential - start));
    }
    EXPECT_LT(most, 0.05 * std::hypot(0.01, 0.005) / 12.0 + 1e-6 * start) << speed;
  }
}

TEST(JointPresliding, BendsAsDahlSaysAndThenSlides) {
  const JointBench bench;
  const double torque = 0.5, distance = 0.02;
  const EffectInstance effect = {
      "joint_presliding", "axis", {{"torque", torque}, {"distance", distance}}};
  Simulation sim(bench.with(effect));
  for (int i = 1; i <= 4000; ++i) {
    sim.apply_effort(0, 0.8 * torque * i / 4000.0);
    sim.step();
  }
  // x = -d log(1 - T / F)
  EXPECT_NEAR(sim.configuration()[0], -distance * std::log1p(-0.8), 0.02 * distance);
  EXPECT_GT(sim.presliding_energy(), 0.0);
  // Without effort it springs back by what the bend has stored, and stays.
  sim.apply_effort(0, 0.0);
  sim.step(4000);
  EXPECT_LT(sim.configuration()[0], -distance * std::log1p(-0.8));
  EXPECT_GT(sim.configuration()[0], 0.2 * distance);
  // Beyond it slides, held back by the whole torque.
  const double expected = (1.5 - torque) / kInertia * 0.2;
  EXPECT_NEAR(bench.speed(effect, 1.5, 0.2), expected, 0.05 * expected);
}

TEST(JointLugre, WithoutStribeckAndDampingIsDahls) {
  const JointBench bench;
  const double torque = 0.5, distance = 0.02;
  const auto course = [&](const EffectInstance& effect) {
    Simulation sim(bench.with(effect));
    std::vector<double> positions;
    for (int i = 0; i < 3000; ++i) {
      sim.apply_effort(0, 1.4 * torque * std::sin(0.004 * i));
      sim.step();
      positions.push_back(sim.configuration()[0]);
    }
    return positions;
  };
  const std::vector<double> dahl =
      course({"joint_presliding", "axis", {{"torque", torque}, {"distance", distance}}});
  EXPECT_EQ(
      course(
          {"joint_lugre", "axis", {{"torque", torque}, {"distance", distance}, {"damping", 0.0}}}),
      dahl);
  EXPECT_GT(dahl[700], distance);
}

TEST(JointLugre, BreaksAwayAndThenSlidesAgainstLess) {
  const JointBench bench;
  const double torque = 0.5, ratio = 1.6;
  const EffectInstance effect = {"joint_lugre",
                                 "axis",
                                 {{"torque", torque},
                                  {"distance", 0.002},
                                  {"static_ratio", ratio},
                                  {"stribeck_velocity", 0.1}}};
  const double held = 0.95 * ratio * torque;
  for (const double side : {1.0, -1.0}) {
    // What the bend lets it do slowly, and no more.
    Simulation sim(bench.with(effect));
    for (int i = 1; i <= 4000; ++i) {
      sim.apply_effort(0, side * held * i / 4000.0);
      sim.step();
    }
    EXPECT_NEAR(sim.configuration()[0], -side * ratio * 0.002 * std::log1p(-0.95), 1e-3) << side;
    sim.apply_effort(0, side * 1.1 * ratio * torque);
    sim.step(300);
    // Once it slides, an effort that could not move it keeps it going.
    sim.apply_effort(0, side * held);
    const double before = sim.tree().velocities()[0];
    sim.step(100);
    EXPECT_NEAR(sim.tree().velocities()[0] - before, side * (held - torque) / kInertia * 0.1,
                1e-3 * (held - torque) / kInertia)
        << side;
  }
}

TEST(JointLugre, ComesToRestAndStays) {
  const JointBench bench;
  Simulation sim(bench.with({"joint_lugre", "axis", {{"torque", 0.5}}}));
  sim.apply_effort(0, 2.0);
  sim.step(200);
  EXPECT_GT(sim.tree().velocities()[0], 10.0);
  sim.apply_effort(0, 0.0);
  sim.step(5000);
  EXPECT_NEAR(sim.tree().velocities()[0], 0.0, 1e-6);
}

TEST(JointPresliding, OfNoDistanceIsDryFriction) {
  const JointBench bench;
  const double torque = 0.5;
  const EffectInstance short_way = {
      "joint_presliding", "axis", {{"torque", torque}, {"distance", 1e-5}}};
  const EffectInstance dry = {"joint_coulomb", "axis", {{"torque", torque}, {"static_ratio", 1.0}}};
  // While it bends, it takes up to torque times distance less.
  const double head_start = std::sqrt(2.0 * torque * 1e-5 / kInertia);
  for (const double effort : {1.5, -0.9, 0.51}) {
    EXPECT_NEAR(bench.speed(short_way, effort, 0.3), bench.speed(dry, effort, 0.3), head_start)
        << effort;
  }
  EXPECT_NEAR(bench.speed(short_way, 0.4, 0.3), 0.0, 1e-3);
}

TEST(JointLoadFriction, OfAGuideGoesWithTheWeightAcrossIt) {
  const JointBench bench(true);
  const double mass = 2.0, weight = mass * 9.81, mu = 0.2;
  const EffectInstance effect = {"joint_load_friction", "axis", {{"mu", mu}}};
  EXPECT_EQ(bench.speed(effect, 0.95 * mu * weight, 0.2), 0.0);
  const double effort = 3.0 * mu * weight;
  EXPECT_NEAR(bench.speed(effect, effort, 0.2), (effort - mu * weight) / mass * 0.2, 1e-3);
  EXPECT_NEAR(bench.speed(effect, -effort, 0.2), -(effort - mu * weight) / mass * 0.2, 1e-3);
}

TEST(JointLoadFriction, OfAShaftGoesWithItsRadius) {
  const JointBench bench;
  const double weight = 2.0 * 9.81, mu = 0.2, radius = 0.03;
  const EffectInstance effect = {"joint_load_friction", "axis", {{"mu", mu}, {"radius", radius}}};
  const double torque = mu * radius * weight;
  EXPECT_EQ(bench.speed(effect, 0.95 * torque, 0.2), 0.0);
  EXPECT_NEAR(bench.speed(effect, 2.0 * torque, 0.2), torque / kInertia * 0.2, 1e-3);
}

TEST(JointEffortFriction, TakesItsShareWhicheverWayTheJointMoves) {
  const JointBench bench;
  const EffectInstance effect = {"joint_effort_friction", "axis", {{"share", 0.3}}};
  EXPECT_NEAR(bench.speed(effect, 0.1, 0.5), 0.7 * 0.1 / kInertia * 0.5, 1e-6);
  EXPECT_NEAR(bench.speed(effect, -0.1, 0.5), -0.7 * 0.1 / kInertia * 0.5, 1e-6);
  // While the effort brakes, friction helps it.
  Simulation sim(bench.with(effect));
  sim.apply_effort(0, 0.1);
  sim.step(500);
  const double before = sim.tree().velocities()[0];
  sim.apply_effort(0, -0.1);
  sim.step(100);
  EXPECT_NEAR(sim.tree().velocities()[0], before - 1.3 * 0.1 / kInertia * 0.1, 1e-6);
}

TEST(EffortGain, ScalesTheEffortThatActs) {
  const JointBench bench;
  EXPECT_NEAR(bench.speed({"effort_gain", "axis", {{"gain", 0.8}}}, 0.1, 0.5),
              0.8 * 0.1 / kInertia * 0.5, 1e-6);
  // The load from outside is what it is.
  Simulation sim(bench.with({"effort_gain", "axis", {{"gain", 0.8}}}));
  sim.apply_load(0, 0.1);
  sim.step(500);
  EXPECT_NEAR(sim.tree().velocities()[0], 0.1 / kInertia * 0.5, 1e-6);
  EXPECT_EQ(sim.joint_effort(0), 0.0);
}

TEST(JointEffects, UnitsOnASlideAreThoseOfForcesAndLengths) {
  const auto robot = load_robot_model(config("driven_axis/model_I.yaml"));
  const auto at = [&](const char* id, const char* name) {
    for (const EffectParameter& p : find_effect(id)->parameters_at(*robot, "axis")) {
      if (p.name == name) return p;
    }
    return EffectParameter{};
  };
  EXPECT_EQ(at("joint_quadratic_drag", "drag").unit, "Ns2/m2");
  // 0.02 Nm at 1 rad/s is 2 N at 0.1 m/s.
  EXPECT_NEAR(at("joint_quadratic_drag", "drag").typical, 0.02 * 1e4, 1e-9);
  EXPECT_EQ(at("joint_presliding", "distance").unit, "m");
  EXPECT_EQ(at("joint_ripple", "periods_3").unit, "1/m");
  EXPECT_EQ(at("joint_ripple", "sine_3").unit, "N");
  EXPECT_EQ(at("joint_load_friction", "radius").name, "");
}

}  // namespace
}  // namespace anthrob
