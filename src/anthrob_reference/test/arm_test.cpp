#include "anthrob_reference/arm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "support.h"

namespace anthrob::reference {
namespace {

constexpr double kDegree = M_PI / 180.0;

// Largest differences over two motions.
struct Difference {
  double joints = 0.0;  // [rad]
  double force = 0.0;   // [N]
};

// All muscles wind in and out, each at its own pace; the arm lifts and bends.
void command_smoothly(Arm* arm) {
  for (std::size_t i = 0; i < arm->muscle_count(); ++i) {
    const double amplitude = 0.25 + 0.1 * static_cast<double>((7 * i) % 11);
    const double rate = 1.5 + 0.3 * static_cast<double>((5 * i) % 11);
    const double reference = 0.3 + 0.5 * amplitude * (1.0 - std::cos(rate * arm->time()));
    arm->command_position(i, reference);
  }
}

// Once NaN, it stays NaN; std::max would forget it.
void raise(double* worst, double value) {
  if (value > *worst || std::isnan(value)) *worst = value;
}

Difference compare(Arm* a, Arm* b, double seconds) {
  Difference worst;
  while (a->time() < seconds) {
    for (Arm* arm : {a, b}) {
      command_smoothly(arm);
      arm->advance(1e-3);
    }
    const double joints =
        a->shoulder().angularDistance(b->shoulder()) + std::abs(a->elbow() - b->elbow());
    raise(&worst.joints, joints);
    for (std::size_t i = 0; i < a->muscle_count(); ++i) {
      raise(&worst.force, std::abs(a->muscle(i).force - b->muscle(i).force));
    }
  }
  return worst;
}

class EachModel : public testing::TestWithParam<std::string> {
 protected:
  ArmParameters parameters_ = Arm::load(model_file(GetParam()));
};

TEST_P(EachModel, LeftAloneItSettlesNearRest) {
  for (const bool powered : {false, true}) {
    Arm arm(parameters_);
    for (std::size_t i = 0; powered && i < arm.muscle_count(); ++i) arm.command_position(i, 0.0);
    arm.advance(5.0);
    const double angle = arm.shoulder().angularDistance(Eigen::Quaterniond::Identity());
    EXPECT_LT(angle, 1.0 * kDegree);
    EXPECT_NEAR(arm.elbow(), 0.0, 1.0 * kDegree);
    EXPECT_LT(arm.shoulder_velocity().norm() + std::abs(arm.elbow_velocity()), 1e-3);
    for (std::size_t i = 0; i < arm.muscle_count(); ++i) {
      EXPECT_LT(arm.muscle(i).force, 1.0) << arm.muscle_names()[i];
    }
  }
}

TEST_P(EachModel, HalvingTheStepChangesNothingThatMatters) {
  for (const double friction : {1.0, 3.0}) {
    Arm arm(parameters_);
    Arm fine(parameters_);
    fine.set_step(Arm::kDefaultStep / 2.0);
    for (Arm* each : {&arm, &fine}) each->scale_eyelet_friction(friction);
    const Difference difference = compare(&arm, &fine, 1.0);
    EXPECT_GT(arm.shoulder().angularDistance(Eigen::Quaterniond::Identity()) + arm.elbow(),
              3.0 * kDegree);
    EXPECT_LT(difference.joints, 1e-5 * kDegree) << "friction x " << friction;
    EXPECT_LT(difference.force, 1e-4) << "friction x " << friction;
  }
}

TEST_P(EachModel, PositionIsReached) {
  Arm arm(parameters_);
  arm.command_position(8, 1.0);
  arm.advance(1.0);
  const MuscleReadings biceps = arm.muscle(8);
  EXPECT_NEAR(biceps.position, 1.0, 0.1);  // a proportional law under load
  EXPECT_GT(biceps.force, 0.0);
  EXPECT_GT(arm.elbow(), 1.0 * kDegree);
  EXPECT_NEAR(biceps.tendon_length,
              parameters_.muscles[8].rest_tendon_length - 0.0065 * biceps.position, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Anthrob, EachModel, testing::Values("model_I", "model_II"));

TEST(Arm, SameCallsGiveSameBits) {
  const ArmParameters parameters = Arm::load(model_file("model_II"));
  Arm a(parameters);
  Arm b(parameters);
  const Difference difference = compare(&a, &b, 0.2);
  EXPECT_EQ(difference.joints, 0.0);
  EXPECT_EQ(difference.force, 0.0);
}

TEST(Arm, AdvanceMayBeCutAnywhere) {
  const ArmParameters parameters = Arm::load(model_file("model_II"));
  Arm whole(parameters);
  Arm pieces(parameters);
  for (Arm* arm : {&whole, &pieces}) command_smoothly(arm);
  whole.advance(0.021);
  for (int k = 0; k < 70; ++k) pieces.advance(0.0003);
  EXPECT_NEAR(pieces.time(), whole.time(), 1e-9);
  EXPECT_NEAR(pieces.muscle(0).position, whole.muscle(0).position, 1e-7);
  EXPECT_NEAR(pieces.elbow(), whole.elbow(), 1e-7);
}

TEST(Arm, StaysStableWithLargeSteppedReferences) {
  Arm arm(Arm::load(model_file("model_II")));
  arm.scale_eyelet_friction(3.0);
  for (int k = 0; k < 10; ++k) {
    for (std::size_t i = 0; i < arm.muscle_count(); ++i) {
      arm.command_position(i, 0.25 * static_cast<double>((3 * k + 4 * i) % 11));
    }
    arm.advance(0.1);
    for (std::size_t i = 0; i < arm.muscle_count(); ++i) {
      EXPECT_GE(arm.muscle(i).force, 0.0);
      EXPECT_LT(arm.muscle(i).force, 500.0);
    }
    EXPECT_LT(arm.shoulder_velocity().norm(), 50.0);
  }
}

TEST(Arm, PlacedArmRestsWithRelaxedRings) {
  const ArmParameters parameters = Arm::load(model_file("model_II"));
  Arm arm(parameters);
  arm.command_position(0, 1.0);
  arm.advance(0.1);
  const Eigen::Quaterniond target = rotation({0.2, 0.1, -0.3});
  arm.place(target, 0.8, std::vector<double>(arm.muscle_count(), 1.5));
  EXPECT_EQ(arm.time(), 0.0);
  EXPECT_NEAR(arm.shoulder().angularDistance(target), 0.0, 1e-12);
  EXPECT_EQ(arm.elbow(), 0.8);
  EXPECT_EQ(arm.shoulder_velocity().norm(), 0.0);
  EXPECT_EQ(arm.kinetic_energy(), 0.0);
  for (std::size_t i = 0; i < arm.muscle_count(); ++i) {
    const MuscleReadings muscle = arm.muscle(i);
    const RingParameters& ring = parameters.muscles[i].ring;
    const double stretch = std::max(0.0, muscle.length - muscle.tendon_length - ring.rest_length);
    const double area =
        ring.quantity * ring.strands * M_PI / 4.0 * ring.section_diameter * ring.section_diameter;
    EXPECT_NEAR(muscle.ring_tension, area * ring.modulus * stretch / ring.rest_length, 1e-9);
    EXPECT_NEAR(muscle.force, muscle.ring_tension, 1e-9);  // nothing slides, no friction
    EXPECT_EQ(muscle.current, 0.0);
    EXPECT_EQ(muscle.voltage, 0.0);
  }
}

TEST(Arm, PlacedTricepsHasGoneAroundTheElbow) {
  // Straight from rest it goes behind the elbow; past half a turn the short way is the wrong one.
  Arm arm(Arm::load(model_file("model_II")));
  const std::vector<double> positions(arm.muscle_count(), 0.0);
  double before = arm.muscle(9).length;
  for (int degrees = 1; degrees <= 134; ++degrees) {
    arm.place(Eigen::Quaterniond::Identity(), degrees * kDegree, positions);
    const double length = arm.muscle(9).length;
    EXPECT_GT(length, before) << degrees;
    EXPECT_LT(arm.moment_arm(9)(3), -0.0149) << degrees;  // the cylinder's radius at least
    before = length;
  }
  EXPECT_GT(arm.muscle(9).wrap_angle, 60.0 * kDegree);
}

TEST(Arm, RefusesWhatHasNoMeaning) {
  const ArmParameters parameters = Arm::load(model_file("model_I"));
  Arm arm(parameters);
  EXPECT_THROW(arm.set_step(0.0), std::invalid_argument);
  EXPECT_THROW(arm.advance(-1.0), std::invalid_argument);
  EXPECT_THROW(arm.command_position(11, 0.0), std::out_of_range);
  EXPECT_THROW(arm.command_voltage(0, NAN), std::invalid_argument);
  EXPECT_THROW(arm.place(Eigen::Quaterniond::Identity(), 0.0, {}), std::invalid_argument);
  ArmParameters mixed = parameters;
  mixed.muscles[3].controller.period = 2e-3;
  EXPECT_THROW(Arm{mixed}, std::invalid_argument);
}

}  // namespace
}  // namespace anthrob::reference
