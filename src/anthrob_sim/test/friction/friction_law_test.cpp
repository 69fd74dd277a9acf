// Capstan friction coefficients: the thesis's smooth law (4.75) and the one that sticks.
#include <gtest/gtest.h>

#include <cmath>

#include "friction/smooth_stribeck.h"
#include "friction/sticking.h"
#include "support.h"

namespace anthrob {
namespace {

constexpr double kStatic = 0.195, kKinetic = 0.156, kVelocity = 0.001, kStickStep = 1e-3;

TEST(SmoothStribeck, IsTheLogisticStribeckCurve) {
  const SmoothStribeck law(kStatic, kKinetic, kVelocity, 10.0);
  for (double v : {-0.05, -1e-3, -1e-5, 1e-6, 2e-4, 3e-3, 0.1}) {
    const double expected = (2.0 / (1.0 + std::exp(-10.0 * v / kVelocity)) - 1.0) *
                            (kKinetic + (kStatic - kKinetic) * std::exp(-std::abs(v) / kVelocity));
    EXPECT_NEAR(law.evaluate(v, StateView()).mu, expected, 1e-15);
  }
  EXPECT_EQ(law.evaluate(0.0, StateView()).mu, 0.0);
}

TEST(SmoothStribeck, SlopeIsItsDerivative) {
  const SmoothStribeck law(kStatic, kKinetic, kVelocity, 10.0);
  for (double v : {-0.01, -4e-3, -1e-3, -2e-5, 0.0, 3e-6, 4e-4, 2e-3, 5e-3}) {
    const double h = 1e-9;
    const double slope =
        (law.evaluate(v + h, StateView()).mu - law.evaluate(v - h, StateView()).mu) / (2 * h);
    EXPECT_NEAR(law.evaluate(v, StateView()).slope, slope, 1e-4 * std::max(1.0, std::abs(slope)));
  }
}

TEST(Sticking, SlidesAtTheKineticLevelInBothDirections) {
  const Sticking law(kStatic, kKinetic, kVelocity, 1e-5, kStickStep);
  double z = 0.0;
  const StateView state(&z);
  for (const double v : {0.05, -0.05}) {
    for (int i = 0; i < 10; ++i) law.commit(v, state);
    EXPECT_NEAR(law.evaluate(v, state).mu, std::copysign(kKinetic, v), 1e-12);
  }
}

TEST(Sticking, HoldsAnythingUpToTheStaticLevelAtRest) {
  const Sticking law(kStatic, kKinetic, kVelocity, 1e-5, kStickStep);
  double z = 0.0;
  const StateView state(&z);
  // Displaced by a share of the presliding distance, then left alone: the same share of mu_s, for
  // ever.
  law.commit(0.7e-5 / kStickStep, state);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_DOUBLE_EQ(law.evaluate(0.0, state).mu, 0.7 * kStatic);
    law.commit(0.0, state);
  }
}

TEST(Sticking, BreaksAwayAtTheStaticLevel) {
  const Sticking law(kStatic, kKinetic, kVelocity, 1e-5, kStickStep);
  double z = 0.0, highest = 0.0;
  const StateView state(&z);
  const double slow = 1e-6;
  for (int i = 0; i < 20000; ++i) {
    highest = std::max(highest, law.evaluate(slow, state).mu);
    law.commit(slow, state);
  }
  EXPECT_NEAR(highest, kStatic, 1e-3 * kStatic);
}

TEST(Sticking, SlopeIsItsDerivative) {
  const Sticking law(kStatic, kKinetic, kVelocity, 1e-5, kStickStep);
  double z = 0.3e-5;
  const StateView state(&z);
  for (double v : {1e-3, -2e-3, 5e-3, 0.05, -0.05}) {
    const double h = 1e-7;
    const double slope = (law.evaluate(v + h, state).mu - law.evaluate(v - h, state).mu) / (2 * h);
    EXPECT_NEAR(law.evaluate(v, state).slope, slope, 1e-3 * std::max(1.0, std::abs(slope)));
  }
}

TEST(BothLaws, DissipateWhateverTheMotion) {
  // Friction power T mu v over random motion; the bristle may give back what it stored, no more.
  testing_support::Random random(3);
  const Sticking sticking(kStatic, kKinetic, kVelocity, 1e-5, kStickStep);
  const SmoothStribeck smooth(kStatic, kKinetic, kVelocity, 10.0);
  for (int run = 0; run < 500; ++run) {
    double z = 0.0, work = 0.0, v = 0.0;
    const StateView state(&z);
    for (int i = 0; i < 500; ++i) {
      v = 0.9 * v + random.uniform(-0.003, 0.003);
      const double power = v * sticking.evaluate(v, state).mu;
      sticking.commit(v, state);
      work += power * kStickStep;
      ASSERT_GE(work, -0.5 * kStatic * 1e-5) << run << " " << i;
      EXPECT_GE(v * smooth.evaluate(v, StateView()).mu, 0.0);
    }
  }
}

}  // namespace
}  // namespace anthrob
