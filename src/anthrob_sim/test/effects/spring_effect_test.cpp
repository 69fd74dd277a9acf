// Effects of tendon and spring, each against a closed form, and what they dissipate.
#include <gtest/gtest.h>

#include <cmath>

#include "effects_support.h"
#include "spring/ring.h"
#include "spring/wiechert.h"

namespace anthrob {
namespace {

using namespace testing_support;

/// A spring of the rig with one effect.
class Stretched {
 public:
  Stretched(const EffectInstance& effect, const std::string& muscle, double step = kStep)
      : spring_(muscle_with(kRig, effect, muscle, step).spring), state_(spring_->state_size()) {
    spring_->relax(0.0, state_);
  }
  double advance(double expansion) { return spring_->advance(expansion, state_); }
  /// To an expansion within a second.
  double go(double from, double to) {
    double tension = 0.0;
    for (int i = 1; i <= 1000; ++i) tension = advance(from + (to - from) * i / 1000.0);
    return tension;
  }
  const SeriesElasticElement& spring() const { return *spring_; }
  StateView state() { return state_; }

 private:
  std::shared_ptr<const SeriesElasticElement> spring_;
  Memory state_;
};

constexpr double kSteel = 1500.0;  // [N/m]; its damping of 5 Ns/m is small at these rates

TEST(TendonElasticity, StretchIsForceTimesLengthOverEA) {
  const double compliance = 2e-4 * 0.3652;  // m/N
  Stretched stretched({"tendon_elasticity", "extensor", {{"compliance", 2e-4}}}, "extensor");
  for (const double tension : {5.0, 20.0, 60.0}) {
    const double expansion = stretched.spring().relaxed_expansion(tension);
    EXPECT_NEAR(expansion, tension / kSteel + compliance * tension, 1e-12);
    EXPECT_NEAR(stretched.spring().relaxed_tension(expansion), tension, 1e-8);
  }
  stretched.go(0.0, 0.02);
  double tension = 0.0;
  for (int i = 0; i < 300; ++i) tension = stretched.advance(0.02);
  EXPECT_NEAR(tension, 0.02 / (1.0 / kSteel + compliance), 1e-6);
  EXPECT_NEAR(stretched.spring().stored_energy(stretched.state()), 0.5 * tension * 0.02, 1e-8);
  EXPECT_EQ(stretched.advance(-0.001), 0.0);
}

TEST(TendonElasticity, StretchesByAllThatTheSpringAndWhatIsBesideItCarry) {
  const EffectInstance arm = {
      "second_maxwell_arm", "flexor", {{"ratio", 0.5}, {"relaxation_time", 0.2}}};
  const auto both = robot_with(kRig, {arm, {"tendon_elasticity", "flexor", {{"compliance", 5e-4}}}})
                        ->muscles[0]
                        .spring;
  const auto without = muscle_with(kRig, arm, "flexor").spring;
  const double compliance =
      (both->relaxed_expansion(10.0) - without->relaxed_expansion(10.0)) / 10.0;
  ASSERT_GT(compliance, 1e-4);
  Memory state(both->state_size()), other(without->state_size());
  both->relax(0.0, state);
  without->relax(0.0, other);
  // Fast: the arm carries a third.
  for (int i = 1; i <= 200; ++i) {
    const double expansion = 5e-5 * i, force = both->advance(expansion, state);
    const double spring = without->advance(expansion - compliance * force, other);
    EXPECT_NEAR(spring, force, 1e-6 + 1e-4 * force) << i;
  }
}

TEST(TendonCreep, GrowsWithTheLogarithmOfTime) {
  const double rate = 1e-4, onset = 2.0, tension = 30.0, length = 0.3652;
  Stretched stretched({"tendon_creep", "extensor", {{"rate", rate}, {"onset", onset}}}, "extensor");
  stretched.spring().relax(tension / kSteel, stretched.state());
  // An end that moves as the law says keeps the force where it is.
  for (int i = 0; i < 60000; ++i) {
    const double creep = rate * length * tension * std::log1p(i * kStep / onset);
    const double found = stretched.advance(tension / kSteel + creep);
    if (i <= 10) continue;
    ASSERT_NEAR(found, tension, 0.01) << i;
  }
  // Unloaded it keeps its length: slack.
  EXPECT_EQ(stretched.go(0.0, 0.5 * rate * length * tension * std::log1p(30.0)), 0.0);
}

TEST(SecondMaxwellArm, IsTheWiechertModelOfTheTwoArms) {
  const double ratio = 0.3, time = 0.05;
  Stretched stretched(
      {"second_maxwell_arm", "flexor", {{"ratio", ratio}, {"relaxation_time", time}}}, "flexor");
  const double e0 = 0.8862e6, d = 0.004;
  const Wiechert exact(Ring{0.015, 2 * 0.25 * M_PI * d * d}, e0,
                       {MaxwellArm(0.1541e6, 0.2428, kStep), MaxwellArm(0.1019e6, 3.0015, kStep),
                        MaxwellArm(ratio * e0, time, kStep)});
  Memory memory(exact.state_size());
  exact.relax(0.0, memory);
  for (int i = 0; i < 500; ++i) {
    const double expansion = 0.004 + 0.003 * std::sin(0.02 * i);
    EXPECT_NEAR(stretched.advance(expansion), exact.advance(expansion, memory), 1e-9);
  }
}

TEST(SeeMullins, SoftensBelowTheLargestStretchAndNotBeyond) {
  const double softening = 0.3;
  Stretched stretched({"see_mullins", "extensor", {{"softening", softening}}}, "extensor");
  const double damping = 5.0, rate = 0.01;
  EXPECT_NEAR(stretched.go(0.0, 0.01), kSteel * 0.01 + damping * rate, 1e-9);
  // At half of it, going down and coming back.
  const double half = (1.0 - softening * 0.75) * kSteel * 0.005;
  EXPECT_NEAR(stretched.go(0.01, 0.005), half - damping * 0.005, 1e-9);
  stretched.go(0.005, 0.0);
  EXPECT_NEAR(stretched.go(0.0, 0.005), half + damping * 0.005, 1e-9);
  // New beyond the old maximum.
  EXPECT_NEAR(stretched.go(0.005, 0.015), kSteel * 0.015 + damping * rate, 1e-9);
}

TEST(SeeHysteresis, LoopIsTwiceTheForceAtAnyRate) {
  const double share = 0.2, working = 0.3 * 0.015;
  const double force = share * kSteel * working;
  for (const double step : {1e-3, 1e-4}) {  // ten times faster
    Stretched stretched({"see_hysteresis", "extensor", {{"share", share}, {"turn", 0.05}}},
                        "extensor", step);
    stretched.go(0.0, 0.012);
    const double down = stretched.go(0.012, 0.008), up_rate = 5.0 * 0.004 / (1000 * step);
    stretched.go(0.008, 0.004);
    const double up = stretched.go(0.004, 0.008);
    EXPECT_NEAR(up - down - 2.0 * up_rate, 2.0 * force, 0.02 * force) << step;
  }
}

TEST(SeeHysteresis, TurnsRoundWithinTheTurn) {
  const double share = 0.2, length = 0.015, damping = 5.0;
  const double force = share * kSteel * 0.3 * length;
  for (const double turn : {0.03, 0.1}) {
    Stretched stretched({"see_hysteresis", "extensor", {{"share", share}, {"turn", turn}}},
                        "extensor");
    double at = 0.03;
    stretched.go(0.0, at);
    // Back by x: z = -1 + 2 exp(-x / (turn l_0)); then forth again from what is left of it.
    double z = 1.0;
    for (const double x : {-0.2, -0.5, -1.0, 0.4, 1.5}) {
      const double to = at + x * turn * length, side = x > 0.0 ? 1.0 : -1.0;
      z = side + (z - side) * std::exp(-std::abs(x));
      const double rate = to - at;  // within a second
      EXPECT_NEAR(stretched.go(at, to), kSteel * to + damping * rate + force * z, 1e-6 * force)
          << turn << " " << x;
      at = to;
    }
  }
}

TEST(SeeToe, IsSoftAtLowStrainOnlyAndReversible) {
  const double softness = 0.4, end = 0.57 * 0.015;
  Stretched stretched({"see_toe", "extensor", {{"softness", softness}}}, "extensor");
  const auto expected = [&](double x) {
    return kSteel * x * (1.0 - softness * (x < end ? std::pow(1.0 - x / end, 2) : 0.0));
  };
  for (const double x : {1e-5, 0.001, 0.004, 0.008, 0.01}) {
    EXPECT_NEAR(stretched.spring().relaxed_tension(x), expected(x), 1e-12);
    EXPECT_NEAR(stretched.spring().relaxed_expansion(expected(x)), x, 1e-9);
  }
  const double damping = 5.0 * 0.004;
  EXPECT_NEAR(stretched.go(0.0, 0.004), expected(0.004) + damping, 1e-9);
  stretched.go(0.004, 0.008);
  EXPECT_NEAR(stretched.go(0.008, 0.004), expected(0.004) - damping, 1e-9);
}

TEST(SeeStiffening, TangentModulusGrowsWithTheStressEitherWay) {
  const double length = 0.015;
  for (const double rate : {1.5, -1.0}) {
    Stretched stretched({"see_stiffening", "extensor", {{"stiffening", rate}}}, "extensor");
    const SeriesElasticElement& spring = stretched.spring();
    for (const double x : {1e-4, 0.002, 0.006, 0.012, 0.03}) {
      const double force = spring.relaxed_tension(x);
      EXPECT_NEAR(force, kSteel * length * (std::exp(rate * x / length) - 1.0) / rate,
                  1e-9 * force);
      EXPECT_NEAR(spring.relaxed_expansion(force), x, 1e-9);
      const double tangent =
          (spring.relaxed_tension(x + 1e-7) - spring.relaxed_tension(x - 1e-7)) / 2e-7;
      EXPECT_NEAR(tangent, kSteel + rate * force / length, 1e-5 * kSteel);
    }
    // The same there and back, but for the spring's own damping.
    const double damping = 5.0 * 0.004, force = spring.relaxed_tension(0.004);
    EXPECT_NEAR(stretched.go(0.0, 0.004), force + damping, 1e-9);
    EXPECT_NEAR(stretched.spring().stored_energy(stretched.state()),
                kSteel * std::pow(length / rate, 2) *
                    (std::exp(rate * 0.004 / length) - 1.0 - rate * 0.004 / length),
                1e-9);
    stretched.go(0.004, 0.008);
    EXPECT_NEAR(stretched.go(0.008, 0.004), force - damping, 1e-9);
  }
}

TEST(SeeStiffening, OfAHundredthIsTheQuadraticLaw) {
  const double rate = 0.01, length = 0.015;
  const auto spring =
      muscle_with(kRig, {"see_stiffening", "extensor", {{"stiffening", rate}}}, "extensor").spring;
  for (const double x : {0.003, 0.009}) {
    const double more = spring->relaxed_tension(x) - kSteel * x;
    EXPECT_NEAR(more, 0.5 * kSteel * rate * x * x / length, 4e-3 * more);
  }
}

/// Work done on a spring over a ragged path, less what it stores and turns into heat, as share.
double unexplained_work(const EffectInstance& effect, const std::string& muscle, double step) {
  Stretched stretched(effect, muscle, step);
  double work = 0.0, heat = 0.0, turned_over = 0.0, last = 0.0, force = 0.0;
  const int steps = static_cast<int>(std::lround(6.0 / step));
  const double start = stretched.spring().stored_energy(stretched.state());
  for (int i = 1; i <= steps; ++i) {
    const double t = i * step;
    const double x = 0.003 * (1.0 - std::cos(2.1 * t)) + 0.0012 * std::sin(7.3 * t);
    const double next = stretched.advance(x);
    work += 0.5 * (force + next) * (x - last);
    turned_over += std::abs(next * (x - last));
    heat += stretched.spring().dissipation((x - last) / step, stretched.state()) * step;
    force = next;
    last = x;
  }
  const double stored = stretched.spring().stored_energy(stretched.state()) - start;
  return std::abs(work - stored - heat) / turned_over;
}

TEST(SpringEffects, EnergyIsAccountedFor) {
  const EffectInstance effects[] = {
      {"second_maxwell_arm", "all", {{"ratio", 0.5}, {"relaxation_time", 0.3}}},
      {"see_mullins", "all", {{"softening", 0.4}}},
      {"see_hysteresis", "all", {{"share", 0.3}}},
      {"see_toe", "all", {{"softness", 0.6}}},
      {"see_stiffening", "all", {{"stiffening", 2.0}}},
      {"see_stiffening", "all", {{"stiffening", -1.0}}},
      {"tendon_elasticity", "all", {{"compliance", 1e-3}}},
      {"tendon_creep", "all", {{"rate", 1e-4}}},
  };
  for (const EffectInstance& effect : effects) {
    for (const char* muscle : {"flexor", "extensor"}) {
      const double coarse = unexplained_work(effect, muscle, 1e-3);
      const double fine = unexplained_work(effect, muscle, 1e-4);
      EXPECT_LT(coarse, 1e-2) << effect.id << " " << muscle;
      EXPECT_LT(fine, 0.3 * coarse + 1e-5) << effect.id << " " << muscle;
    }
  }
}

}  // namespace
}  // namespace anthrob
