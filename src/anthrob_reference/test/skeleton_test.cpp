#include "anthrob_reference/skeleton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support.h"

namespace anthrob::reference {
namespace {

// The skeleton alone: no muscles, friction or stops.
ArmParameters bare() {
  ArmParameters parameters = Arm::load(model_file("model_I"));
  parameters.muscles.clear();
  parameters.skeleton.shoulder_friction.viscous = 0.0;
  parameters.skeleton.elbow_friction.viscous = 0.0;
  parameters.skeleton.elbow_stop.stiffness = 0.0;
  parameters.skeleton.elbow_stop.damping = 0.0;
  return parameters;
}

// Lifted sideways and to the front, elbow bent: it will swing.
Arm lifted(const ArmParameters& parameters) {
  Arm arm(parameters);
  arm.place(rotation({0.9, 0.4, -0.8}), 1.2, std::vector<double>(arm.muscle_count(), 0.0));
  return arm;
}

double vertical_angular_momentum(const Arm& arm, const Skeleton& skeleton,
                                 const SkeletonParameters& parameters) {
  JointState state;
  state.shoulder = arm.shoulder();
  state.elbow = arm.elbow();
  state.velocity << arm.shoulder_velocity(), arm.elbow_velocity();
  const Vector4 momentum = skeleton.mass_matrix(skeleton.posture(state)) * state.velocity;
  const Eigen::Vector3d about_shoulder = momentum.head<3>();
  return (parameters.X_WH_rest.linear() * (state.shoulder * about_shoulder)).z();
}

TEST(Skeleton, RestPostureIsThatOfTheArm) {
  const SkeletonParameters parameters = Arm::load(model_file("model_I")).skeleton;
  const Posture posture = Skeleton(parameters).posture(JointState{});
  // The humerus hangs: its shoulder is 0.22 m above the elbow.
  const Eigen::Vector3d elbow_W = parameters.X_WH_rest.linear() * posture.elbow_centre;
  EXPECT_NEAR((elbow_W - Eigen::Vector3d(0.0, 0.0, -0.22)).norm(), 0.0, 1e-9);
  // The base sees the world upright.
  const Eigen::Vector3d up =
      parameters.X_WH_rest.linear() * posture.frame(Body::kBase).R_HX * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR((up - Eigen::Vector3d::UnitZ()).norm(), 0.0, 1e-12);
  // Flexion brings the hand to the front, where the biceps is.
  JointState bent;
  bent.elbow = M_PI / 2.0;
  const Eigen::Vector3d hand =
      Skeleton(parameters).posture(bent).point(Body::kForearm, {0.0, -0.2, 0.0});
  EXPECT_NEAR((hand - Eigen::Vector3d(0.0, -0.22, 0.2)).norm(), 0.0, 1e-9);
}

TEST(Skeleton, KineticEnergyIsThatOfTheMovingBodies) {
  const SkeletonParameters parameters = bare().skeleton;
  const Skeleton skeleton(parameters);
  std::mt19937 generator(3);
  for (int k = 0; k < 20; ++k) {
    const JointState state = random_state(&generator);
    const double h = 1e-5;
    double energy = 0.0;
    for (const Body body : {Body::kHumerus, Body::kForearm}) {
      const BodyParameters& mass = body == Body::kHumerus ? parameters.humerus : parameters.forearm;
      const auto com = [&](double time) {
        const JointState at = moved(state, time * state.velocity);
        return Eigen::Vector3d(at.shoulder * skeleton.posture(at).point(body, mass.com));
      };
      const Eigen::Vector3d v = (com(h) - com(-h)) / (2.0 * h);
      Eigen::Vector3d w =
          skeleton.posture(state).frame(body).R_HX.transpose() * state.velocity.head<3>();
      if (body == Body::kForearm) w += state.velocity(3) * parameters.elbow_axis_F;
      energy += 0.5 * mass.mass * v.squaredNorm() + 0.5 * w.dot(mass.inertia * w);
    }
    EXPECT_NEAR(skeleton.kinetic_energy(state), energy, 1e-8 * energy);
  }
}

TEST(Skeleton, WeightIsTheGradientOfThePotential) {
  const Skeleton skeleton(bare().skeleton);
  std::mt19937 generator(4);
  for (int k = 0; k < 20; ++k) {
    JointState state = random_state(&generator);
    state.velocity.setZero();
    const Vector4 torque = skeleton.forces(state, skeleton.posture(state));
    const double h = 1e-5;
    for (int axis = 0; axis < 4; ++axis) {
      const Vector4 step = h * Vector4::Unit(axis);
      const double slope = (skeleton.potential_energy(moved(state, step)) -
                            skeleton.potential_energy(moved(state, -step))) /
                           (2.0 * h);
      EXPECT_NEAR(torque(axis), -slope, 1e-8);
    }
  }
}

TEST(Skeleton, FreeDoublePendulumKeepsEnergyAndVerticalMomentum) {
  const ArmParameters parameters = bare();
  const Skeleton skeleton(parameters.skeleton);
  Arm arm = lifted(parameters);
  arm.set_step(2e-5);
  const double potential = arm.potential_energy();
  const double total = potential + arm.kinetic_energy();
  double largest = 0.0;
  for (int k = 0; k < 100; ++k) {
    arm.advance(0.02);
    const double energy = arm.potential_energy() + arm.kinetic_energy();
    EXPECT_NEAR(energy, total, 1e-9 * std::abs(total));
    EXPECT_NEAR(vertical_angular_momentum(arm, skeleton, parameters.skeleton), 0.0, 1e-10);
    largest = std::max(largest, arm.kinetic_energy());
  }
  EXPECT_GT(largest, 0.3);  // it did swing
}

TEST(Skeleton, MotionConvergesWithThirdOrder) {
  const auto run = [](double step) {
    Arm arm = lifted(bare());
    arm.set_step(step);
    arm.advance(0.5);
    return arm;
  };
  const Arm exact = run(2.5e-5);
  const auto error = [&](double step) {
    const Arm arm = run(step);
    return arm.shoulder().angularDistance(exact.shoulder()) + std::abs(arm.elbow() - exact.elbow());
  };
  // Steps above the default, where truncation is well above rounding.
  EXPECT_GT(std::log2(error(1e-3) / error(5e-4)), 2.8);
}

TEST(Skeleton, ViscousFrictionTakesEnergyOut) {
  ArmParameters parameters = bare();
  parameters.skeleton.shoulder_friction.viscous = 0.15;
  parameters.skeleton.elbow_friction.viscous = 0.02;
  Arm arm = lifted(parameters);
  double before = arm.potential_energy();
  for (int k = 0; k < 100; ++k) {
    arm.advance(0.01);
    const double energy = arm.potential_energy() + arm.kinetic_energy();
    EXPECT_LT(energy, before + 1e-12);
    before = energy;
  }
}

TEST(Skeleton, DryFrictionOpposesTheRotation) {
  SkeletonParameters parameters = bare().skeleton;
  const Skeleton smooth(parameters);
  parameters.shoulder_friction.dry = {0.3, 0.2, 0.05, 10.0};
  parameters.elbow_friction.dry = {0.06, 0.04, 0.05, 10.0};
  const Skeleton dry(parameters);
  JointState state;
  state.velocity << 2.0, -1.0, 2.0, -4.0;  // fast: kinetic level
  const Posture posture = dry.posture(state);
  const Vector4 torque = dry.forces(state, posture) - smooth.forces(state, posture);
  EXPECT_NEAR((torque - Vector4(-0.4 / 3.0, 0.2 / 3.0, -0.4 / 3.0, 0.04)).norm(), 0.0, 1e-9);
}

TEST(Skeleton, DryFrictionHoldsALightLoad) {
  // Creep only: the smooth law holds 0.5 Nm of weight at a fraction of the Stribeck velocity.
  ArmParameters parameters = bare();
  parameters.skeleton.shoulder_friction.dry = {2.0, 2.0, 0.05, 10.0};
  parameters.skeleton.elbow_friction.dry = {0.5, 0.5, 0.05, 10.0};
  Arm arm(parameters);
  arm.place(rotation({0.3, 0.0, -0.3}), 0.5, {});
  arm.advance(1.0);
  EXPECT_LT(arm.shoulder().angularDistance(rotation({0.3, 0.0, -0.3})), 0.01);
  EXPECT_NEAR(arm.elbow(), 0.5, 0.01);
}

TEST(Skeleton, ImpactOnTheStopKeepsThirdOrder) {
  // The damper of the stop switches on at once; unless the step is cut there, the order is lost.
  ArmParameters parameters = bare();
  parameters.skeleton.elbow_stop.stiffness = 2000.0;
  parameters.skeleton.elbow_stop.damping = 2.0;
  const auto fall = [&](double step) {
    Arm arm(parameters);
    arm.set_step(step);
    arm.place(Eigen::Quaterniond::Identity(), 0.5, {});
    arm.advance(1.0);
    return arm.elbow();
  };
  const double exact = fall(1e-5);
  EXPECT_NEAR(fall(1.25e-4), exact, 5e-5);
  EXPECT_NEAR(fall(6.25e-5), exact, 6e-6);
  EXPECT_NEAR(fall(3.125e-5), exact, 8e-7);
}

TEST(Skeleton, ElbowStopPushesBackAndNeverPulls) {
  ArmParameters parameters = bare();
  const Skeleton free(parameters.skeleton);
  parameters.skeleton.elbow_stop.stiffness = 2000.0;
  parameters.skeleton.elbow_stop.damping = 2.0;
  const Skeleton stopped(parameters.skeleton);
  const double upper = parameters.skeleton.elbow_stop.upper;
  const struct {
    double angle, speed, torque;
  } cases[] = {{-1e-3, -0.5, 3.0},      {-1e-3, 0.5, 1.0},         {-1e-3, 1.5, 0.0},
               {1e-3, -5.0, 0.0},       {upper + 1e-3, 0.5, -3.0}, {upper + 1e-3, -1.5, 0.0},
               {upper - 1e-3, 5.0, 0.0}};
  for (const auto& c : cases) {
    JointState state;
    state.elbow = c.angle;
    state.velocity(3) = c.speed;
    const Posture posture = free.posture(state);
    const Vector4 torque = stopped.forces(state, posture) - free.forces(state, posture);
    EXPECT_NEAR(torque(3), c.torque, 1e-9) << c.angle << " " << c.speed;
    EXPECT_EQ(torque.head<3>().norm(), 0.0);
  }
}

}  // namespace
}  // namespace anthrob::reference
