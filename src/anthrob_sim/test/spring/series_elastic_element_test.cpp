// Series elastic elements against the closed forms of section 4.3 and Appendix B.
#include <gtest/gtest.h>

#include <cmath>

#include "spring/spring_damper.h"
#include "spring/wiechert.h"
#include "spring/zener.h"
#include "support.h"

namespace anthrob {
namespace {

constexpr double kStretchStep = 1e-3;
// Ring 15x5 of Tables 7.2, C.4 and C.5.
constexpr double kRest = 0.015, kArea = 2 * 0.25 * M_PI * 0.005 * 0.005;
const Ring kRing{kRest, kArea};
constexpr double kE0 = 0.8129e6, kE1 = 0.1375e6, kTau = 1.2886;

class Element {
 public:
  explicit Element(const SeriesElasticElement& element)
      : element_(element), memory_(element.state_size(), 0.0) {
    element_.relax(0.0, state());
  }
  double stretch(double strain) { return element_.advance(strain * kRest, state()); }
  StateView state() { return StateView(memory_.data()); }

 private:
  const SeriesElasticElement& element_;
  std::vector<double> memory_;
};

/// Tension over time after a strain step taken within one time step.
template <class Model, class Expected>
void expect_relaxation(const Model& model, double strain, Expected expected, double tolerance) {
  Element ring(model);
  ring.stretch(strain);
  for (int i = 1; i <= 10000; ++i) {
    const double force = ring.stretch(strain);
    // The ramp of one step acts like a sudden stretch half a step earlier, to second order.
    EXPECT_NEAR(force, expected((i + 0.5) * kStretchStep), tolerance) << "step " << i;
  }
}

TEST(Zener, RelaxationFollowsTheClosedForm) {
  const Zener zener(kRing, kE0, MaxwellArm(kE1, kTau, kStretchStep));
  // (4.51), (4.52) and the exponential between them.
  expect_relaxation(
      zener, 0.8, [](double t) { return kArea * 0.8 * (kE0 + kE1 * std::exp(-t / kTau)); }, 1e-6);
}

TEST(Zener, CreepFollowsTheClosedForm) {
  // Constant stress: e(t) = s/E_0 - (s/E_0 - s/(E_0 + E_1)) exp(-t / tau_c), tau_c = tau (E_0 +
  // E_1) / E_0.
  const Zener zener(kRing, kE0, MaxwellArm(kE1, kTau, kStretchStep));
  Element ring(zener);
  const double force = 20.0, stress = force / kArea;
  const double retardation = kTau * (kE0 + kE1) / kE0;
  double strain = stress / (kE0 + kE1);
  ring.stretch(strain);
  for (int i = 1; i <= 5000; ++i) {
    // Find the strain that keeps the force: the element is linear, so a secant step is exact.
    std::vector<double> saved(zener.state_size());
    std::copy(ring.state().data(), ring.state().data() + saved.size(), saved.begin());
    const auto try_strain = [&](double e) {
      std::copy(saved.begin(), saved.end(), ring.state().data());
      return ring.stretch(e);
    };
    const double f0 = try_strain(strain), f1 = try_strain(strain + 0.01);
    strain += 0.01 * (force - f0) / (f1 - f0);
    try_strain(strain);
    const double t = (i + 0.5) * kStretchStep;  // stretched within one step
    const double expected =
        stress / kE0 - (stress / kE0 - stress / (kE0 + kE1)) * std::exp(-t / retardation);
    ASSERT_NEAR(strain, expected, 1e-6);  // (4.48) at t = 0, (4.49) at infinity
  }
}

TEST(Zener, MaxwellModelIsTheLimitWithoutTheParallelSpring) {
  const Zener maxwell(kRing, 0.0, MaxwellArm(kE1, 0.2, kStretchStep));
  expect_relaxation(
      maxwell, 0.5, [](double t) { return kArea * 0.5 * kE1 * std::exp(-t / 0.2); }, 1e-4);
}

TEST(Zener, VoigtModelIsTheLimitOfAStiffShortArm) {
  // E_1 -> infinity, tau_1 -> 0 with viscosity mu = E_1 tau_1: stress = E e + mu de/dt (B.11),
  // (B.7).
  const double viscosity = 0.1e6, tau = 1e-6;
  const Zener voigt(kRing, kE0, MaxwellArm(viscosity / tau, tau, kStretchStep));
  Element ring(voigt);
  const double rate = 0.5;
  double strain = 0.0, force = 0.0;
  for (int i = 0; i < 100; ++i) force = ring.stretch(strain += rate * kStretchStep);
  EXPECT_NEAR(force, kArea * (kE0 * strain + viscosity * rate), 1e-9);
}

TEST(Wiechert, RelaxationIsTheSumOfItsArms) {
  const Wiechert wiechert(
      kRing, 0.8045e6,
      {MaxwellArm(0.1272e6, 0.2366, kStretchStep), MaxwellArm(0.0827e6, 2.9414, kStretchStep)});
  expect_relaxation(
      wiechert, 1.2,
      [](double t) {  // (4.59)
        return kArea * 1.2 *
               (0.8045e6 + 0.1272e6 * std::exp(-t / 0.2366) + 0.0827e6 * std::exp(-t / 2.9414));
      },
      1e-5);
}

TEST(Wiechert, OneArmIsAZener) {
  const Zener zener(kRing, kE0, MaxwellArm(kE1, kTau, kStretchStep));
  const Wiechert wiechert(kRing, kE0, {MaxwellArm(kE1, kTau, kStretchStep)});
  Element a(zener), b(wiechert);
  for (int i = 0; i < 3000; ++i) {
    const double strain = 0.5 * std::sin(0.01 * i);
    EXPECT_EQ(a.stretch(strain), b.stretch(strain));
  }
}

TEST(SpringDamper, ClosedForm) {
  const SpringDamper spring(0.01, 2000.0, 5.0, kStretchStep);
  Element element(spring);
  EXPECT_EQ(spring.relaxed_tension(0.002), 4.0);
  EXPECT_EQ(spring.relaxed_tension(-0.002), 0.0);
  double expansion = 0.0, force = 0.0;
  StateView state = element.state();
  for (int i = 0; i < 10; ++i) force = spring.advance(expansion += 1e-5, state);
  EXPECT_NEAR(force, 2000.0 * expansion + 5.0 * 0.01, 1e-9);
}

class EveryElement : public ::testing::TestWithParam<int> {
 protected:
  std::shared_ptr<const SeriesElasticElement> make(double step = kStretchStep) const {
    switch (GetParam()) {
      case 0:
        return std::make_shared<Zener>(kRing, kE0, MaxwellArm(kE1, kTau, step));
      case 1:
        return std::make_shared<Wiechert>(
            kRing, kE0,
            std::vector<MaxwellArm>{MaxwellArm(kE1, 0.2, step), MaxwellArm(kE1, 3.0, step)});
      default:
        return std::make_shared<SpringDamper>(kRest, 3000.0, 20.0, step);
    }
  }
};

TEST_P(EveryElement, NeverPushes) {
  const auto element = make();
  std::vector<double> memory(element->state_size());
  testing_support::Random random(7);
  double expansion = 0.0;
  for (int i = 0; i < 100000; ++i) {
    expansion = std::min(0.03, std::max(-0.01, expansion + random.uniform(-5e-4, 5e-4)));
    const double force = element->advance(expansion, StateView(memory.data()));
    ASSERT_GE(force, 0.0);
    if (expansion <= 0.0) {
      ASSERT_EQ(force, 0.0);
    }
  }
}

TEST_P(EveryElement, WorkGoesIntoSpringsAndHeat) {
  // Over a motion that also goes slack: work done = change of stored energy + heat.
  const double step = 1e-5;
  const auto element = make(step);
  std::vector<double> memory(element->state_size());
  const StateView state(memory.data());
  double x = 0.004;
  element->relax(x, state);
  const double start = element->stored_energy(state);
  double work = 0.0, heat = 0.0, turned_over = 0.0;
  double last = element->relaxed_tension(x), last_power = 0.0;
  for (int i = 1; i <= 1000000; ++i) {
    const double t = i * step;
    const double next = 0.004 + 0.006 * std::sin(8.0 * t) + 0.002 * std::sin(31.0 * t);
    const double force = element->advance(next, state);
    const double power = element->dissipation((next - x) / step, state);
    work += 0.5 * (force + last) * (next - x);
    turned_over += std::abs(0.5 * (force + last) * (next - x));
    heat += 0.5 * (power + last_power) * step;
    last = force, last_power = power, x = next;
  }
  EXPECT_GT(turned_over, 0.5);
  EXPECT_NEAR(work, element->stored_energy(state) - start + heat, 2e-4 * turned_over);
  EXPECT_GT(work, 0.0);
}

TEST_P(EveryElement, RelaxedTensionAndExpansionAreInverse) {
  const auto element = make();
  for (double tension : {0.5, 5.0, 50.0}) {
    EXPECT_NEAR(element->relaxed_tension(element->relaxed_expansion(tension)), tension,
                1e-12 * tension);
  }
}

TEST_P(EveryElement, RelaxMeansForEver) {
  const auto element = make();
  std::vector<double> memory(element->state_size());
  element->relax(0.004, StateView(memory.data()));
  const double force = element->relaxed_tension(0.004);
  for (int i = 0; i < 1000; ++i)
    EXPECT_NEAR(element->advance(0.004, StateView(memory.data())), force, 1e-12 * force);
}

INSTANTIATE_TEST_SUITE_P(All, EveryElement, ::testing::Values(0, 1, 2));

}  // namespace
}  // namespace anthrob
