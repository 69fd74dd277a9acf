// Friction that bends before it slides: closed forms, and that it never creates energy.
#include "friction/bristle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/random.h"

namespace anthrob::bristles {
namespace {

constexpr double kStep = 1e-3;

BristleModel lugre(double static_ratio, double damping) {
  BristleModel model;
  model.torque = 0.4;
  model.distance = 0.02;
  model.static_ratio = static_ratio;
  model.stribeck_velocity = 0.1;
  model.damping = damping;
  return model;
}

/// One step that begins and ends at a speed.
double step(Bristle& law, double speed, double& z) {
  law.begin(speed);
  const double friction = law.friction(speed, z);
  z = law.bend(speed, z);
  return friction;
}

TEST(Bristle, SlidesAsTheStribeckCurveSays) {
  const BristleModel model = lugre(1.5, 0.03);
  Bristle law(model, kStep);
  for (const double speed : {0.02, -0.1, 0.25, -3.0}) {
    double z = 0.0, friction = 0.0;
    for (double way = 0.0; way < 40.0 * model.distance; way += std::abs(speed) * kStep) {
      friction = step(law, speed, z);
    }
    const double curve = 1.0 + 0.5 * std::exp(-std::pow(speed / 0.1, 2));
    EXPECT_NEAR(friction, std::copysign(0.4 * curve, speed), 1e-9) << speed;
  }
}

TEST(Bristle, IsASpringWithADamperWhereItHardlyBends) {
  const BristleModel model = lugre(1.3, 0.05);
  Bristle law(model, 1e-5);
  double z = 0.0, way = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double speed = 1e-3 * std::cos(200e-5 * i);
    way += 1e-5 * speed;
    EXPECT_NEAR(step(law, speed, z), 0.4 / 0.02 * (way + 0.05 * speed),
                4e-3 * 0.4 / 0.02 * 0.05 * 1e-3)
        << i;
  }
}

TEST(Bristle, SlopeIsThatOfItsFriction) {
  Bristle law(lugre(1.6, 0.02), kStep);
  for (const double begin : {0.0, 0.07, -2.0}) {
    law.begin(begin);
    for (const double z : {-1.2, -0.3, 0.0, 0.9, 1.4}) {
      for (const double speed : {-5.0, -0.4, -0.01, 0.02, 0.6, 40.0}) {
        const double apart = 1e-5 * std::abs(speed);
        const double slope =
            (law.friction(speed + apart, z) - law.friction(speed - apart, z)) / (2.0 * apart);
        EXPECT_NEAR(law.slope(speed, z), slope, 1e-6 * std::abs(slope) + 1e-8)
            << begin << " " << z << " " << speed;
      }
    }
  }
}

TEST(Bristle, NoStepCreatesEnergy) {
  const CounterRandom random(7);
  std::uint64_t draw = 0;
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * random.uniform(draw++);
  };
  for (int run = 0; run < 300; ++run) {
    const BristleModel model = lugre(uniform(1.0, 3.0), run % 3 == 0 ? 0.0 : uniform(0.0, 1.0));
    Bristle law(model, kStep);
    double z = 0.0, before = 0.0, speed = 0.0;
    for (int i = 0; i < 200; ++i) {
      // Speeds of all sizes, with leaps and reversals within a step.
      if (uniform(0.0, 1.0) < 0.4) speed = uniform(-1.0, 1.0) * std::exp(uniform(-9.0, 5.0));
      law.begin(before);
      const double work = law.friction(speed, z) * speed * kStep, had = law.energy(z);
      z = law.bend(speed, z);
      EXPECT_GE(work + had - law.energy(z), -1e-12 * (std::abs(work) + had)) << run << " " << i;
      before = speed;
    }
  }
}

}  // namespace
}  // namespace anthrob::bristles
