#include "anthrob_reference/friction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "anthrob_reference/muscle.h"
#include "load.h"
#include "support.h"

namespace anthrob::reference {
namespace {

SmoothStribeck eyelet() {
  return SmoothStribeck({0.195, 0.156, 1e-3, 10.0});
}

TEST(SmoothStribeck, HasTheFormOf475) {
  for (const double v : {-0.5, -2e-3, -1e-4, 3e-5, 8e-4, 0.02}) {
    const double sign = 2.0 / (1.0 + std::exp(-10.0 * v / 1e-3)) - 1.0;
    const double expected = sign * (0.156 + 0.039 * std::exp(-std::abs(v) / 1e-3));
    EXPECT_NEAR(eyelet().value(v), expected, 1e-15);
  }
  EXPECT_EQ(eyelet().value(0.0), 0.0);
  EXPECT_NEAR(eyelet().value(1.0), 0.156, 1e-15);
}

TEST(SmoothStribeck, SlopeIsItsDerivative) {
  EXPECT_NEAR(eyelet().slope(0.0), 0.195 * 10.0 / 2e-3, 1e-9);
  for (const double v : {-3e-3, -2e-4, 5e-5, 7e-4, 4e-3}) {
    const double h = 1e-8;
    const double difference = (eyelet().value(v + h) - eyelet().value(v - h)) / (2.0 * h);
    EXPECT_NEAR(eyelet().slope(v), difference, 1e-5 * std::abs(difference));
  }
}

TEST(SmoothStribeck, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(SmoothStribeck({-0.1, 0.1, 1e-3, 10.0}), std::invalid_argument);
  EXPECT_THROW(SmoothStribeck({0.1, 0.1, 0.0, 10.0}), std::invalid_argument);
  EXPECT_THROW(SmoothStribeck({0.1, 0.1, 1e-3, 0.0}), std::invalid_argument);
}

// Right angles at both eyelets, ring between them; the insertion moves with the humerus.
MuscleParameters right_angles() {
  MuscleParameters muscle = Arm::load(model_file("model_I")).muscles.front();
  muscle.path = {{Body::kBase, {0.0, 0.1, 0.0}, {}},
                 {Body::kBase, {0.0, 0.0, 0.0}, {}},
                 {Body::kBase, {0.1, 0.0, 0.0}, {}},
                 {Body::kHumerus, {0.1, 0.0, 0.1}, {}}};
  muscle.ring_segment = 1;
  muscle.sensor_segment = 0;
  muscle.rest_tendon_length = 0.27;
  return muscle;
}

TEST(Eyelet, TakesTensionInTheDirectionOfSliding) {
  const Muscle muscle(right_angles());
  const double gain = std::exp(0.156 * M_PI / 2.0);
  const double fast = 10.0;  // [rad/s], far beyond the Stribeck velocity
  for (const int direction : {-1, 1}) {
    // Turning about +y lowers the insertion towards the eyelet below it.
    Vector4 velocity = Vector4::Zero();
    velocity.head<3>() = direction * fast * Eigen::Vector3d::UnitY();
    MuscleState state;
    state.speed = direction * fast;
    MuscleSolution solution;
    muscle.solve(Posture{}, velocity, state, &solution);
    const double ring = muscle.ring_tension(solution);
    ASSERT_GT(ring, 1.0);
    // Winding in: the motor pulls against the friction before the ring.
    EXPECT_NEAR(solution.tensions[0] / ring, std::pow(gain, direction), 1e-9);
    // The path beyond the ring gets shorter, the tendon runs towards its origin, and the insertion
    // feels less.
    EXPECT_GT(direction * solution.sliding[1], 0.1);
    EXPECT_NEAR(solution.tensions[2] / ring, std::pow(gain, -direction), 1e-9);
    EXPECT_EQ(muscle.sensor_force(solution), solution.tensions[0]);
  }
}

TEST(Eyelet, SlackTendonCarriesNothing) {
  const Muscle muscle(right_angles());
  MuscleState state;
  state.position = -10.0;
  state.speed = 1.0;
  MuscleSolution solution;
  muscle.solve(Posture{}, Vector4::Ones(), state, &solution);
  for (const double tension : solution.tensions) EXPECT_EQ(tension, 0.0);
  EXPECT_EQ(solution.torque.norm(), 0.0);
}

// A loaded muscle of the real arm in a random state.
class LoadedMuscles : public testing::Test {
 protected:
  template <typename Check>
  void for_each(const Check& check) {
    const ArmParameters parameters = Arm::load(model_file("model_II"));
    const Skeleton skeleton(parameters.skeleton);
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (const MuscleParameters& muscle_parameters : parameters.muscles) {
      Muscle muscle(muscle_parameters);
      for (int k = 0; k < 20; ++k) {
        JointState joints = random_state(&generator);
        joints.velocity *= 0.1 * std::abs(uniform(generator));
        const Posture posture = skeleton.posture(joints);
        muscle.path().reset_contacts(posture);
        MuscleState state;
        state.position = 8.0;
        state.speed = uniform(generator);
        check(muscle, posture, joints.velocity, state);
      }
    }
  }
};

TEST_F(LoadedMuscles, EyeletsOnlyDissipate) {
  for_each([](const Muscle& muscle, const Posture& posture, const Vector4& velocity,
              const MuscleState& state) {
    MuscleSolution solution;
    muscle.solve(posture, velocity, state, &solution);
    for (std::size_t j = 0; j < solution.sliding.size(); ++j) {
      const double loss = (solution.tensions[j] - solution.tensions[j + 1]) * solution.sliding[j];
      EXPECT_GE(loss, 0.0);
    }
  });
}

TEST_F(LoadedMuscles, WhatTheSpindlePutsInGoesSomewhere) {
  for_each([](const Muscle& muscle, const Posture& posture, const Vector4& velocity,
              const MuscleState& state) {
    MuscleSolution solution;
    muscle.solve(posture, velocity, state, &solution);
    const double h = 1e-3;
    const double tendon_rate =
        (muscle.tendon_length(state.position + h) - muscle.tendon_length(state.position - h)) /
        (2.0 * h) * state.speed;
    double path_rate = 0.0;
    for (const SpanSolution& span : solution.path.spans) path_rate -= span.arm.dot(velocity);
    double power = muscle.ring_tension(solution) * (path_rate - tendon_rate);  // into the ring
    power += solution.torque.dot(velocity);                                    // into the skeleton
    for (std::size_t j = 0; j < solution.sliding.size(); ++j) {                // into heat
      power += (solution.tensions[j] - solution.tensions[j + 1]) * solution.sliding[j];
    }
    EXPECT_NEAR(power, -solution.tensions.front() * tendon_rate, 1e-9);
  });
}

TEST_F(LoadedMuscles, DampingIsTheDerivativeOfTheTorque) {
  for_each([](const Muscle& muscle, const Posture& posture, const Vector4& velocity,
              const MuscleState& state) {
    MuscleSolution solution;
    muscle.solve(posture, velocity, state, &solution);
    Matrix4 damping = Matrix4::Zero();
    muscle.add_damping(solution, &damping);
    const double h = 1e-6;
    for (int k = 0; k < 4; ++k) {
      MuscleSolution up, down;
      muscle.solve(posture, velocity + h * Vector4::Unit(k), state, &up);
      muscle.solve(posture, velocity - h * Vector4::Unit(k), state, &down);
      const Vector4 slope = -(up.torque - down.torque) / (2.0 * h);
      EXPECT_NEAR((damping.col(k) - slope).norm(), 0.0, 1e-4 * (1.0 + slope.norm()));
    }
  });
}

}  // namespace
}  // namespace anthrob::reference
