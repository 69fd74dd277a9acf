// Least-effort tensions, and equilibria that the simulation really takes.
#include "anthrob_sim/statics/equilibrium.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/errors.h"
#include "effects/effects_support.h"
#include "support.h"

namespace anthrob {
namespace {

using testing_support::config;
using testing_support::Random;

TEST(LeastEffort, TwoAntagonistsByHand) {
  Eigen::MatrixXd A(1, 2);
  A << 0.05, -0.04;
  Eigen::VectorXd tau(1);
  tau << 1.0;
  const auto result = least_effort(A, tau, Eigen::Vector2d(2, 2), Eigen::Vector2d(100, 100));
  EXPECT_NEAR(result.tension[1], 2.0, 1e-9);  // the antagonist idles
  EXPECT_NEAR(result.tension[0], (1.0 + 0.04 * 2.0) / 0.05, 1e-6);
  EXPECT_NEAR(result.shortfall[0], 0.0, 1e-6);
}

TEST(LeastEffort, SharesLikeArmsWithoutBounds) {
  // Least squares: tension in proportion to the moment arm.
  Eigen::MatrixXd A(1, 3);
  A << 0.05, 0.03, 0.01;
  Eigen::VectorXd tau(1);
  tau << 2.0;
  const auto result = least_effort(A, tau, Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(500));
  const Eigen::Vector3d expected = A.transpose() * (2.0 / A.squaredNorm());
  EXPECT_LT((result.tension - expected).norm(), 1e-6);
}

TEST(LeastEffort, SaysWhatItCannotDeliver) {
  Eigen::MatrixXd A(1, 1);
  A << 0.05;
  Eigen::VectorXd tau(1);
  tau << 10.0;
  const auto result =
      least_effort(A, tau, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, 100.0));
  EXPECT_NEAR(result.tension[0], 100.0, 0.05);
  EXPECT_NEAR(result.shortfall[0], 5.0, 0.003);
  const auto pushing =
      least_effort(A, -tau, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, 100.0));
  EXPECT_NEAR(pushing.tension[0], 0.0, 1e-6);
}

TEST(LeastEffort, RandomProblemsSatisfyTheOptimalityConditions) {
  // Karush-Kuhn-Tucker: f = clamp(A^T lambda) for some lambda.
  Random random(9);
  int checked = 0;
  for (int run = 0; run < 200; ++run) {
    const int n = 4, m = 11;
    Eigen::MatrixXd A(n, m);
    for (int i = 0; i < n * m; ++i) A.data()[i] = random.uniform(-0.06, 0.06);
    Eigen::VectorXd inside(m);
    for (int i = 0; i < m; ++i) inside[i] = random.uniform(1.0, 80.0);
    const Eigen::VectorXd tau = A * inside;
    const Eigen::VectorXd lo = Eigen::VectorXd::Constant(m, 1.0),
                          hi = Eigen::VectorXd::Constant(m, 80.0);
    const auto result = least_effort(A, tau, lo, hi);
    EXPECT_LT(result.shortfall.norm(), 1e-6);
    // Multipliers from the muscles strictly between their bounds.
    std::vector<int> free;
    for (int i = 0; i < m; ++i) {
      if (result.tension[i] > 1.0 + 1e-6 && result.tension[i] < 80.0 - 1e-6) free.push_back(i);
    }
    // Too few where the torque is at the border of what the muscles can do.
    if (static_cast<int>(free.size()) < n) continue;
    ++checked;
    Eigen::MatrixXd At(free.size(), n);
    Eigen::VectorXd f(free.size());
    for (std::size_t i = 0; i < free.size(); ++i)
      At.row(i) = A.col(free[i]).transpose(), f[i] = result.tension[free[i]];
    const Eigen::VectorXd lambda = At.colPivHouseholderQr().solve(f);
    for (int i = 0; i < m; ++i) {
      const double want = std::min(80.0, std::max(1.0, A.col(i).dot(lambda)));
      EXPECT_NEAR(result.tension[i], want, 1e-4);
    }
  }
  EXPECT_GT(checked, 150);
}

TEST(LeastEffort, RefusesWhatDoesNotFit) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Ones(1, 2);
  EXPECT_THROW(
      least_effort(A, Eigen::VectorXd::Zero(2), Eigen::VectorXd::Zero(2), Eigen::VectorXd::Ones(2)),
      std::invalid_argument);
  EXPECT_THROW(
      least_effort(A, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(2), Eigen::VectorXd::Zero(2)),
      std::invalid_argument);
}

TEST(Equilibrium, TheSimulationTakesIt) {
  // Without eyelet friction the references lead to the posture they were derived for.
  for (const char* name : {"I", "II", "III"}) {
    const auto model = load_robot_model(
        config(std::string("anthrob/model_") + name + ".yaml"),
        {1e-3, {{"eyelet_friction.static", 0.0}, {"eyelet_friction.kinetic", 0.0}}});
    Simulation scratch(model), sim(model);
    // Abducted 40 degrees (about -x-y of the world at rest), elbow bent by 60.
    const Mat3 R = scratch.tree().joint(0).R_WC;
    const Quat lift(Eigen::AngleAxisd(0.7, R.transpose() * Vec3(-1, -1, 0).normalized()));
    const std::vector<double> q{lift.w(), lift.x(), lift.y(), lift.z(), 1.05};
    const Equilibrium e = find_equilibrium(scratch, q);
    EXPECT_LT(e.shortfall.norm(), 1e-6) << name;
    for (int m = 0; m < 11; ++m) sim.command(m, ecu::Mode::kPosition, e.reference[m]);
    sim.step(15000);
    const auto& now = sim.configuration();
    EXPECT_LT(angular_distance(Quat(now[0], now[1], now[2], now[3]), lift), 0.01) << name;
    EXPECT_NEAR(now[4], 1.05, 0.01) << name;
    for (int m = 0; m < 11; ++m) {
      EXPECT_NEAR(sim.muscle(m).force(), e.tension[m], 0.3)
          << name << " " << model->muscles[m].name;
      EXPECT_NEAR(sim.muscle(m).actuator().position, e.position[m], 0.01) << name;
    }
  }
}

TEST(Equilibrium, AsksNoHillMuscleForMoreThanItCanPullIn) {
  const auto model = load_robot_model(config("two_muscle_rig/model_hill.yaml"));
  Simulation scratch(model), sim(model);
  int limited = 0, held = 0;
  for (double angle = -1.5; angle < 1.9; angle += 0.3) {
    const Equilibrium e = find_equilibrium(scratch, {angle});
    for (std::size_t m = 0; m < model->muscles.size(); ++m) {
      const double highest = model->muscles[m].actuator->highest_position();
      EXPECT_LE(e.position[m], highest + 1e-9) << angle;
      limited += e.position[m] > highest - 1e-6;
    }
    // What it says is what the simulation finds there.
    sim.place({angle}, e.position);
    for (std::size_t m = 0; m < model->muscles.size(); ++m) {
      EXPECT_NEAR(sim.muscle(static_cast<int>(m)).spring_tension(), e.tension[m], 1e-3) << angle;
    }
    held += e.shortfall.norm() < 1e-6;
  }
  EXPECT_GT(limited, 0);
  EXPECT_GT(held, 0);
  EXPECT_THROW(sim.place({0.0}, std::vector<double>(model->muscles.size(), 5.0)), BadInput);
  EXPECT_THROW(sim.muscle_inputs().impose_position(0, 5.0, 0.0), BadInput);
  // As a sensor may read it.
  const double highest = model->muscles[0].actuator->highest_position();
  EXPECT_NO_THROW(sim.muscle_inputs().impose_position(0, highest + 0.001, 0.0));
}

/// Nothing chooses a ligament's tension: slack it has none, taut what its stretch gives, and the
/// muscles carry the rest.
TEST(Equilibrium, LigamentsPullAsTheirStretchSays) {
  const auto model = load_robot_model(config("two_muscle_rig/model_hill.yaml"),
                                      {1e-3, {{"muscles.capsule.rest_tendon_length", 0.168}}});
  const int capsule = model->find_muscle("capsule");
  Simulation scratch(model);
  int taut = 0, slack = 0;
  for (const double angle : {-0.6, -0.2, -0.1, 0.0, 0.1, 0.2, 0.6}) {
    const Equilibrium e = find_equilibrium(scratch, {angle}, {1.0, 200.0});
    const double stretch = scratch.muscle(capsule).length() - 0.168 - 0.02;
    ++(stretch > 0.0 ? taut : slack);
    EXPECT_NEAR(e.tension[capsule], 8000.0 * std::max(0.0, stretch), 1e-9) << angle;
    if (e.shortfall.norm() > 1e-6) continue;
    const Eigen::VectorXd tension = Eigen::Map<const Eigen::VectorXd>(e.tension.data(), 3);
    EXPECT_NEAR((moment_arm_matrix(scratch) * tension - holding_load(scratch)).norm(), 0.0, 1e-6);
  }
  EXPECT_GT(taut, 0);
  EXPECT_GT(slack, 0);
}

TEST(Equilibrium, SaysThatNoReferenceHoldsWithoutAGain) {
  MuscleModel muscle = load_robot_model(config("anthrob/model_II.yaml"))->muscles[0];
  muscle.controller.position.proportional = 0.0;
  try {
    position_reference(muscle, 0.4, 10.0);
    FAIL();
  } catch (const BadInput& e) {
    EXPECT_NE(std::string(e.what()).find(muscle.name + ": position.proportional"),
              std::string::npos);
  }
}

TEST(Equilibrium, CountsOnNoForceThatIsNotMeasured) {
  const auto with_limit = [](double force) {
    return load_robot_model(config("two_muscle_rig/model_I.yaml"),
                            {1e-3, {{"controllers.pd.limits.force", force}}});
  };
  const auto model = with_limit(0.0);
  const MuscleModel& muscle = model->muscles[0];
  EXPECT_FALSE(muscle.has_force_sensor());
  Simulation sim(model);
  for (int m = 0; m < 2; ++m) sim.command(m, ecu::Mode::kPosition, 1.0);
  sim.step(1000);
  const double tension = sim.muscle(0).force();
  ASSERT_GT(tension, 1.0);
  const double length = sim.muscle(0).length();
  const ecu::PositionGains& gains = muscle.controller.position;
  ASSERT_GT(gains.force_feedforward, 0.0);
  EXPECT_NEAR(position_reference(muscle, length, tension) -
                  position_reference(with_limit(100.0)->muscles[0], length, tension),
              gains.force_feedforward * tension / gains.proportional, 1e-12);
  // Nor does the control law: to some 1 mV, for the muscle still moves a little.
  const ecu::Measurement& seen = sim.muscle(0).measured();
  EXPECT_NEAR(sim.muscle(0).voltage(),
              gains.proportional * (1.0 - seen.position) - gains.derivative * seen.velocity, 1e-3);
  EXPECT_GT(gains.force_feedforward * tension, 0.1);
}

TEST(Equilibrium, HoldsWhatEffectsPutOnTheJoints) {
  const double stiffness = 0.8, torque = 0.6;
  const auto with = testing_support::robot_with(
      "anthrob/model_II.yaml", {{"cable_drag", "shoulder", {{"stiffness", stiffness}}},
                                {"joint_offset_torque", "elbow", {{"torque", torque}}}});
  const Quat lift(Eigen::AngleAxisd(0.5, Vec3(-0.6, 0.0, 0.8)));
  const std::vector<double> q{lift.w(), lift.x(), lift.y(), lift.z(), 1.05};
  Simulation bent(with), plain(load_robot_model(config("anthrob/model_II.yaml")));
  for (Simulation* sim : {&bent, &plain}) sim->place(q, std::vector<double>(11, 0.0));
  const Eigen::VectorXd more = holding_load(bent) - holding_load(plain);
  EXPECT_NEAR((more.head<3>() - stiffness * 0.5 * Vec3(-0.6, 0.0, 0.8)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(more[3], -torque, 1e-12);
}

}  // namespace
}  // namespace anthrob
