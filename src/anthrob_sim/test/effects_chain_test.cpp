// Effects from the motor to the path, each against a closed form, and what they dissipate.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "anthrob_sim/actuator/dc_motor.h"
#include "anthrob_sim/spring/ring.h"
#include "anthrob_sim/spring/wiechert.h"
#include "effects_support.h"

namespace anthrob {
namespace {

using namespace testing_support;

const char* const kRig = "two_muscle_rig/model_I.yaml";
const char* const kArm = "anthrob/model_II.yaml";
constexpr double kStep = 1e-3;
constexpr double kSpindleRadius = 0.0065;  // of the rig [m]

/// The rig's flexor motor with one effect, outside a simulation.
class Bench {
 public:
  explicit Bench(const EffectInstance& effect, const std::string& file = kRig,
                 const std::string& muscle = "flexor")
      : actuator_(muscle_with(file, effect, muscle).actuator), state_(actuator_->state_size()) {
    actuator_->place(0.0, state_);
  }
  Bench& run(double volts, double load, int steps) {
    for (int i = 0; i < steps; ++i) actuator_->advance(volts, load, state_);
    return *this;
  }
  Bench& impose(double position, double load) {
    actuator_->impose(position, (position - read().position) / kStep, load, state_);
    return *this;
  }
  void place(double position) { actuator_->place(position, state_); }
  Actuator::Readout read() { return actuator_->read(state_); }
  double length() { return actuator_->tendon_length(state_); }
  double winding_speed() { return actuator_->winding_speed(state_); }
  const Actuator& actuator() const { return *actuator_; }

 private:
  std::shared_ptr<const Actuator> actuator_;
  Memory state_;
};

const EffectInstance kNothing = {"gear_backlash", "flexor", {{"width", 0.0}}};

// --- motor
// ----------------------------------------------------------------------------------------

TEST(SeriesResistance, TakesCurrentFromAStalledMotor) {
  Bench bench({"series_resistance", "flexor", {{"resistance", 0.5}}});
  // The load and the gear's friction hold the shaft: i = V / R.
  bench.run(1.0, 60.0, 50);
  bench.impose(0.0, 60.0);
  EXPECT_NEAR(bench.run(1.0, 60.0, 1).read().current, 1.0 / (4.69 + 0.12 + 0.5), 2e-3);
}

TEST(WindingHeating, ResistanceFollowsCopperAndHeatReachesItsBalance) {
  const double rise = 40.0, copper = 0.0039, winding = 4.69, stage = 0.12, volts = 1.6;
  Bench bench(
      {"winding_heating", "flexor", {{"thermal_resistance", rise}, {"time_constant", 1.0}}});
  const double load = 50.0;  // between running down and being pulled in: the shaft stands
  const double cold = bench.run(volts, load, 20).read().current;
  ASSERT_EQ(bench.read().velocity, 0.0);
  EXPECT_NEAR(cold, volts / (winding + stage), 1e-3);
  const double warm = bench.run(volts, load, 12000).read().current;
  // Balance of dT = R_th R(dT) i^2 and i = V / R.
  double warmth = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double hot = winding * (1.0 + copper * warmth), current = volts / (hot + stage);
    warmth = rise * hot * current * current;
  }
  EXPECT_GT(warmth, 15.0);
  EXPECT_NEAR(warm, volts / (winding * (1.0 + copper * warmth) + stage), 3e-4 * warm);
  EXPECT_LT(warm, 0.97 * cold);
}

/// A winding of the rig's motor, stalled: what its current says of its temperature.
struct Winding {
  static constexpr double kCopper = 0.0039, kCold = 4.69, kStage = 0.12;
  static constexpr double kHold = 50.0;  // [N] at 1.6 V the shaft stands

  static double hot(double warmth) { return kCold * (1.0 + kCopper * warmth); }
  static double warmth(double current, double volts) {
    return ((volts / current - kStage) / kCold - 1.0) / kCopper;
  }
  /// The equation for a stall at a voltage, in small steps.
  static double warmed(double rise, double time_constant, double volts, double seconds) {
    constexpr double kSmall = 1e-4;
    double warmth = 0.0;
    for (double t = 0.0; t < seconds; t += kSmall) {
      const double current = volts / (hot(warmth) + kStage);
      warmth += kSmall / time_constant * (rise * hot(warmth) * current * current - warmth);
    }
    return warmth;
  }
};

TEST(WindingHeating, WarmsByItsTimeConstant) {
  const double rise = 60.0, volts = 1.6;
  for (const double time_constant : {1.0, 4.0}) {
    Bench bench({"winding_heating",
                 "flexor",
                 {{"thermal_resistance", rise}, {"time_constant", time_constant}}});
    const double current = bench.run(volts, Winding::kHold, 2000).read().current;
    ASSERT_EQ(bench.read().velocity, 0.0);
    const double expected = Winding::warmed(rise, time_constant, volts, 2.0);
    EXPECT_GT(expected, 8.0);
    EXPECT_NEAR(Winding::warmth(current, volts), expected, 0.02 * expected);
  }
}

TEST(WindingHeating, GoesOnWhereTheMotorIsMovedFromOutside) {
  const double rise = 60.0, volts = 1.6, hold = Winding::kHold;
  const EffectInstance effect = {
      "winding_heating", "flexor", {{"thermal_resistance", rise}, {"time_constant", 1.0}}};
  // Its current stays the one it had: dT' = (R_th R(dT) i^2 - dT) / time_constant, linear in dT.
  Bench heated(effect);
  const double current = heated.run(volts, hold, 1).read().current;
  for (int i = 0; i < 1500; ++i) heated.impose(0.0, hold);
  EXPECT_EQ(heated.read().current, current);
  const double power = rise * Winding::kCold * current * current;
  const double pace = 1.0 - Winding::kCopper * power;
  const double expected = power / pace * -std::expm1(-1.5 * pace);
  EXPECT_GT(expected, 15.0);
  const double found = Winding::warmth(heated.run(volts, hold, 1).read().current, volts);
  EXPECT_NEAR(found, expected, 0.02 * expected);
  // Without current it cools.
  Bench cooled(effect);
  const double warm = Winding::warmth(cooled.run(volts, hold, 5000).read().current, volts);
  cooled.run(0.0, 0.0, 1);
  ASSERT_NEAR(cooled.read().current, 0.0, 1e-3);
  for (int i = 0; i < 700; ++i) cooled.impose(0.0, hold);
  EXPECT_NEAR(Winding::warmth(cooled.run(volts, hold, 1).read().current, volts),
              warm * std::exp(-0.7), 0.02 * warm);
}

TEST(WindingHeating, WeakensTheMagnets) {
  const double magnet = 0.003, ratio = 128.0, constant = 0.00973, efficiency = 0.59;
  Bench bench({"winding_heating",
               "flexor",
               {{"thermal_resistance", 200.0}, {"time_constant", 100.0}, {"magnet", magnet}}});
  const double stalled = bench.run(12.0, 400.0, 1000).read().current;
  ASSERT_EQ(bench.read().velocity, 0.0);
  const double warmth = Winding::warmth(stalled, 12.0);
  ASSERT_GT(warmth, 30.0);
  // Winding in: the current carries the load, the rest of the voltage is back-EMF.
  const double load = 20.0, volts = 8.0;
  const Actuator::Readout motor = bench.run(volts, load, 300).read();
  const double weak = constant * (1.0 - magnet * warmth);
  const double current = load * kSpindleRadius / (efficiency * ratio * weak);
  EXPECT_NEAR(motor.current, current, 1e-2 * current);
  const double emf = volts - (Winding::hot(warmth) + Winding::kStage) * motor.current;
  EXPECT_NEAR(motor.velocity, emf / (ratio * weak), 1e-2 * motor.velocity);
}

TEST(Cogging, FirstPushIsTheAmplitudeAndWorkOverATurnIsNone) {
  const double amplitude = 2e-3, phase = 1.0, ratio = 128.0, inertia = 4.6e-7;
  const EffectInstance effect = {
      "cogging",
      "flexor",
      {{"sine", amplitude * std::cos(phase)}, {"cosine", amplitude * std::sin(phase)}}};
  // No load, so no friction in the rig's gear: one step from rest.
  Bench bench(effect);
  const double torque = amplitude * ratio * std::sin(phase);
  const double expected = torque * kStep / (inertia * ratio * ratio);
  EXPECT_NEAR(bench.run(0.0, 0.0, 1).read().velocity, expected, 0.05 * expected);
  // Left alone it comes to rest where the torque is none and the slope holds.
  bench.run(0.0, 0.0, 20000);
  const double angle = 12.0 * ratio * bench.read().position + phase;
  EXPECT_NEAR(std::sin(angle), 0.0, 1e-3);
  EXPECT_LT(std::cos(angle), 0.0);
  // Mean speed at a voltage far above it is that of the plain motor.
  Bench plain(kNothing), cogged(effect);
  plain.run(6.0, 0.0, 2000), cogged.run(6.0, 0.0, 2000);
  EXPECT_NEAR(cogged.read().position, plain.read().position, 2e-3 * plain.read().position);
}

TEST(Cogging, ComesToRestUpToTheLimitAndIsRefusedBeyond) {
  const double inertia = 4.6e-7, periods = 100.0, limit = 1.5 * inertia / (kStep * kStep * periods);
  Bench bench({"cogging", "flexor", {{"sine", 0.98 * limit}, {"periods", periods}}});
  for (double start = 0.1; start < 2.0 * M_PI; start += 0.2) {
    bench.place(start / (periods * 128.0));
    bench.run(0.0, 0.0, 10000);
    EXPECT_LT(std::abs(bench.read().velocity), 1e-5) << start;
  }
  const EffectInstance beyond = {
      "cogging", "flexor", {{"cosine", -1.01 * limit}, {"periods", periods}}};
  try {
    robot_with(kRig, {beyond});
    FAIL() << "accepted";
  } catch (const BadInput& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("effect cogging at flexor: cosine: -0.006969: expected an amplitude below "
                        "0.0069 Nm with so many periods and this step"),
              std::string::npos)
        << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
  EXPECT_NO_THROW(robot_with(kRig, {beyond}, 0.5 * kStep));
}

TEST(GearEfficiency, ChangesTheLoadByDirection) {
  const MuscleModel muscle =
      muscle_with(kRig, {"gear_efficiency", "flexor", {{"loss", 0.2}}}, "flexor");
  const auto& gear = *static_cast<const DcMotor&>(*muscle.actuator).gear();
  const double eta = 0.59 * 0.8;
  EXPECT_NEAR(gear.efficiency(), eta, 1e-15);
  const GearLaw::Load load = gear.load(1.0, 0.0, 0.0);
  EXPECT_NEAR(load.torque + load.friction, 1.0 / eta, 1e-12);  // winding in
  EXPECT_NEAR(load.torque - load.friction, eta, 1e-12);        // running down
}

TEST(GearEfficiency, ChangesTheLoadByTheSignOfTheCurrent) {
  for (const double loss : {0.2, -0.2}) {
    const MuscleModel muscle =
        muscle_with(kArm, {"gear_efficiency", "brachialis", {{"loss", loss}}}, "brachialis");
    const auto& gear = *static_cast<const DcMotor&>(*muscle.actuator).gear();
    const double eta = 0.59 * (1.0 - loss);
    EXPECT_NEAR(gear.efficiency(), eta, 1e-15);
    for (const double velocity : {2.0, -2.0}) {
      for (const double current : {1.0, -1.0}) {
        const double torque = velocity * current > 0.0 ? 1.0 / eta : eta;  // driving, driven
        const GearLaw::Load load = gear.load(1.0, velocity, current);
        EXPECT_NEAR(load.torque, torque, 1e-9);
        EXPECT_EQ(load.friction, 0.0);
      }
    }
  }
  // Winding in under a load, the motor's current pays for it.
  const double load = 20.0;
  Bench lossy({"gear_efficiency", "brachialis", {{"loss", 0.2}}}, kArm, "brachialis");
  Bench plain({"gear_efficiency", "brachialis", {{"loss", 0.0}}}, kArm, "brachialis");
  const double more =
      lossy.run(8.0, load, 1000).read().current / plain.run(8.0, load, 1000).read().current;
  ASSERT_GT(lossy.read().velocity, 1.0);
  EXPECT_NEAR(more, 1.0 / 0.8, 1e-6);
}

TEST(GearBacklash, UnloadedTheTendonStandsWhileTheMotorCrossesTheWidth) {
  const double width = 0.02;
  Bench bench({"gear_backlash", "flexor", {{"width", width}, {"drag", 0.01}}});
  const double low = 0.5;  // N: 0.003 Nm, less than the drag
  for (int i = 1; i <= 10; ++i) bench.impose(0.01 * i, low);
  const double wound = bench.length();
  EXPECT_NEAR(wound, 0.3652 - kSpindleRadius * 0.1, 1e-12);
  for (int i = 1; i <= 10; ++i) bench.impose(0.1 - 0.1 * width * i, low);
  EXPECT_NEAR(bench.length(), wound, 1e-12);  // just across
  bench.impose(0.1 - 3.0 * width, low);
  EXPECT_NEAR(bench.length(), wound + kSpindleRadius * 2.0 * width, 1e-12);
  EXPECT_NEAR(bench.winding_speed(), -kSpindleRadius * 2.0 * width / kStep, 1e-9);
}

TEST(GearBacklash, VanishesUnderPretension) {
  Bench bench({"gear_backlash", "flexor", {{"width", 0.02}, {"drag", 0.01}}});
  double largest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double position = 0.3 * std::sin(0.003 * i);
    bench.impose(position, 30.0);
    largest = std::max(largest, std::abs(bench.length() - (0.3652 - kSpindleRadius * position)));
  }
  EXPECT_LT(largest, 1e-9);
}

TEST(GearBacklash, WhatTheTendonDoesInThePlayIsLost) {
  const double width = 0.05, load = 3.0;
  Bench bench({"gear_backlash", "flexor", {{"width", width}, {"drag", 0.01}}});
  bench.impose(1.0, 0.5);
  bench.impose(1.0 - width, 0.5);  // the spindle leads by the width, the motor stands
  double work = 0.0;
  for (int i = 0; i < 500; ++i) {
    const double before = bench.length();
    bench.impose(1.0 - width, load);
    EXPECT_GE(bench.length(), before - 1e-15);
    work += load * (bench.length() - before);
  }
  EXPECT_NEAR(work, load * kSpindleRadius * width, 1e-12);
}

TEST(GearBacklash, FreeSpindleSlidesAsFastAsTheExcessOverTheDrag) {
  const double width = 0.05, drag = 0.01, load = 3.0;
  Bench bench({"gear_backlash", "flexor", {{"width", width}, {"drag", drag}}});
  bench.impose(1.0, 0.5);
  bench.impose(1.0 - width, 0.5);
  const double speed = (load * kSpindleRadius - drag) / (drag * 0.1);  // [rad/s]
  ASSERT_GT(width, 4.0 * speed * kStep);
  const double start = bench.length();
  for (int i = 1; i <= 4; ++i) {
    bench.impose(1.0 - width, load);
    EXPECT_NEAR(bench.length() - start, kSpindleRadius * speed * kStep * i, 1e-12);
    EXPECT_NEAR(bench.winding_speed(), -kSpindleRadius * speed, 1e-9);
  }
}

TEST(GearBacklash, BetweenTheFlanksTheMotorCarriesNothing) {
  Bench bench({"gear_backlash", "flexor", {{"width", 0.05}, {"drag", 0.01}}}), plain(kNothing);
  bench.impose(1.0, 0.5);
  for (int i = 0; i < 2; ++i) bench.impose(0.98, 0.5), plain.impose(0.98, 0.0);
  bench.run(2.0, 1.0, 1);
  plain.run(2.0, 0.0, 1);
  EXPECT_NEAR(bench.read().velocity, plain.read().velocity, 1e-9);
}

TEST(SpindleGrowth, LengthIsAParabolaAndPowerIsKept) {
  const double growth = 5e-4;
  Bench bench({"spindle_growth", "flexor", {{"growth", growth}}});
  for (const double position : {0.0, 3.0, 12.0, -4.0}) {
    bench.place(position);
    const double length =
        0.3652 - kSpindleRadius * position - growth * position * position / (4.0 * M_PI);
    EXPECT_NEAR(bench.length(), length, 1e-12);
    EXPECT_NEAR(bench.actuator().position_for(length), position, 1e-9);
    // The voltage that holds grows with the radius.
    Bench plain(kNothing);
    EXPECT_NEAR(bench.actuator().holding_input(position, 20.0),
                plain.actuator().holding_input(position, 20.0) *
                    (1.0 + growth * position / (2.0 * M_PI * kSpindleRadius)),
                1e-12);
  }
  bench.place(12.0);
  const double before = bench.length();
  bench.run(6.0, 5.0, 1);
  bench.run(6.0, 5.0, 200);
  const double last = bench.length();
  bench.run(6.0, 5.0, 1);
  EXPECT_LT(last, before);
  EXPECT_NEAR(bench.winding_speed(), (last - bench.length()) / kStep, 1e-4 * bench.winding_speed());
}

TEST(SpindleGrowth, PositionForALengthIsItsInverseDownToTheThinnest) {
  const double growth = 0.003, thinnest = -0.9 * 2.0 * M_PI * kSpindleRadius / growth;
  Bench bench({"spindle_growth", "flexor", {{"growth", growth}}});
  for (const double position : {5.0, 0.0, -8.0, -9.6, -11.0, 0.999 * thinnest, 1.001 * thinnest,
                                1.1 * thinnest, 2.0 * thinnest}) {
    bench.place(position);
    EXPECT_NEAR(bench.actuator().position_for(bench.length()), position, 1e-9);
    const double length = bench.length();
    bench.place(position + 1e-4);
    const double radius = std::max(0.1, 1.0 - 0.9 * position / thinnest) * kSpindleRadius;
    EXPECT_NEAR((length - bench.length()) / 1e-4, radius, 1e-6) << position;
  }
}

TEST(SpindleGrowth, MotorCarriesTheLoadOnTheRadiusThatIsThere) {
  const double growth = 5e-4, load = 20.0;
  for (const double position : {12.0, -8.0}) {
    Bench bench({"spindle_growth", "flexor", {{"growth", growth}}}), plain(kNothing);
    bench.place(position), plain.place(position);
    for (int i = 0; i < 100; ++i) {
      const double turns = bench.read().position / (2.0 * M_PI);
      const double thickness = 1.0 + growth * turns / kSpindleRadius;
      bench.run(6.0, load, 1), plain.run(6.0, load * thickness, 1);
      ASSERT_NEAR(bench.read().velocity, plain.read().velocity, 1e-9) << i;
      ASSERT_NEAR(bench.read().current, plain.read().current, 1e-9) << i;
    }
    // What the shaft gives, the tendon takes.
    ASSERT_GT(bench.read().velocity, 1.0);
    const double thickness = 1.0 + growth * bench.read().position / (2.0 * M_PI * kSpindleRadius);
    EXPECT_NEAR(bench.winding_speed(), kSpindleRadius * thickness * bench.read().velocity, 1e-12);
  }
}

// --- tendon and spring
// ----------------------------------------------------------------------------

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

// --- path
// -----------------------------------------------------------------------------------------

TEST(EyeletFriction, TensionRatioIsTheCapstans) {
  const double mu = 0.1;
  const auto robot = robot_with(kArm, {{"eyelet_friction", "biceps_brachii/1", {{"mu", mu}}}});
  const int biceps = robot->find_muscle("biceps_brachii");
  const auto& obstacles = robot->muscles[biceps].path->obstacles();
  Memory nothing(4);
  EXPECT_NEAR(obstacles[1].friction->evaluate(1.0, nothing).mu, 0.156 + mu, 1e-12);
  EXPECT_NEAR(obstacles[2].friction->evaluate(1.0, nothing).mu, 0.156, 1e-12);
  // In the chain, winding in: what the motor feels over what the spring pulls.
  Simulation sim(robot);
  for (int i = 1; i <= 500; ++i) {
    sim.impose_position(biceps, 0.004 * i, 4.0);
    sim.step();
  }
  const Muscle& muscle = sim.muscle(biceps);
  ASSERT_GT(muscle.tension(1), 1.0);
  EXPECT_NEAR(muscle.tension(0) / muscle.tension(1),
              std::exp((0.156 + mu) * muscle.path().obstacles()[1].turning), 1e-6);
}

TEST(EyeletFriction, BringsTheThesisLawWhereThereIsNone) {
  const auto law = muscle_with("two_muscle_rig/model_II.yaml",
                               {"wrap_friction", "flexor", {{"mu", 0.2}}}, "flexor")
                       .path->obstacles()[2]
                       .friction;
  ASSERT_TRUE(law);
  Memory nothing(4);
  EXPECT_NEAR(law->evaluate(1.0, nothing).mu, 0.2, 1e-12);
  EXPECT_NEAR(law->evaluate(-1.0, nothing).mu, -0.2, 1e-12);
  EXPECT_NEAR(law->level(0.0), 0.25, 1e-12);
}

TEST(EyeletFriction, ExcessAtRestIsFreeAndTheSlopeIsTheCurves) {
  const double mu = 0.1, model = 0.156;
  for (const double rest_ratio : {0.7, 1.0, 1.4}) {
    const auto robot = robot_with(
        kArm, {{"eyelet_friction", "biceps_brachii/1", {{"mu", mu}, {"rest_ratio", rest_ratio}}}});
    const auto& obstacles = robot->muscles[robot->find_muscle("biceps_brachii")].path->obstacles();
    const FrictionLaw &raised = *obstacles[1].friction, &own = *obstacles[2].friction;
    EXPECT_NEAR(raised.level(1.0), model + mu, 1e-12);
    EXPECT_NEAR(raised.level(0.0) / own.level(0.0), 1.0 + mu / model * rest_ratio, 1e-12);
    Memory nothing(4);
    for (const double v : {-3e-3, -4e-4, 2e-4, 1e-3, 5e-3}) {
      const double h = 1e-9;
      const double slope =
          (raised.evaluate(v + h, nothing).mu - raised.evaluate(v - h, nothing).mu) / (2.0 * h);
      EXPECT_NEAR(raised.evaluate(v, nothing).slope, slope, 1e-4 * std::abs(slope) + 1e-4) << v;
    }
  }
}

TEST(EyeletFriction, SlopeOfABristleIsTheCurvesWhereItGivesBackToo) {
  for (const double rest_ratio : {0.5, 1.4, 2.0}) {
    const auto law =
        muscle_with(kRig,
                    {"eyelet_friction", "flexor/1", {{"mu", 0.1}, {"rest_ratio", rest_ratio}}},
                    "flexor")
            .path->obstacles()[1]
            .friction;
    for (const double bend : {-9e-6, -5e-6, 0.0, 5e-6}) {  // [m]; the model's law slides at 1e-5
      Memory memory(law->state_size());
      memory.at(0) = bend;
      for (const double v : {-2e-2, -2e-3, -5e-4, 1e-4, 5e-4, 3e-3, 2e-2}) {
        const double h = 1e-8;
        const double slope =
            (law->evaluate(v + h, memory).mu - law->evaluate(v - h, memory).mu) / (2.0 * h);
        EXPECT_NEAR(law->evaluate(v, memory).slope, slope, 1e-4 * std::abs(slope) + 1e-3)
            << rest_ratio << " " << bend << " " << v;
      }
    }
  }
}

TEST(WrapFriction, ActsWhereTheTendonSlidesOverTheSurface) {
  // The rig with a surface on the base, over which the flexor slides to its insertion on the arm.
  const TemporaryRobot robot("", "extends: " + config(kRig) + R"(
muscles:
  flexor:
    eyelet_friction: {law: none}
    path:
      - {point: [0.03, 0.0, 0.80], body: base}
      - {point: [0.03, 0.0, 0.62], body: base}
      - {cylinder: {origin: [0.01, 0.0, 0.5], axis: [0, 1, 0], radius: 0.025}, body: base}
      - {point: [0.02, 0.0, -0.08], body: arm}
effects:
  - {id: wrap_friction, place: flexor/2, mu: 0.2}
)");
  Simulation sim(robot.load());
  // The extensor swings the arm back and pulls the flexor over the surface.
  for (int i = 1; i <= 300; ++i) {
    sim.impose_position(0, 0.0, 0.0);
    sim.impose_position(1, 0.01 * i, 10.0);
    sim.step();
  }
  const Muscle& flexor = sim.muscle(0);
  const double turning = flexor.path().obstacles()[2].turning;
  ASSERT_GT(turning, 0.05);
  ASSERT_GT(flexor.tension(1), 1.0);
  ASSERT_GT(std::abs(flexor.sliding().slide_speed[0]), 0.002);
  EXPECT_NEAR(std::abs(std::log(flexor.tension(1) / flexor.tension(2))), 0.2 * turning,
              0.1 * 0.2 * turning);
  EXPECT_GT(flexor.friction_power(), 0.0);
}

TEST(EyeletPresliding, FrictionFollowsDisplacementAndStaysAtRest) {
  const double distance = 4e-4;
  const auto law =
      muscle_with(kArm, {"eyelet_presliding", "brachialis", {{"distance", distance}}}, "brachialis")
          .path->obstacles()[1]
          .friction;
  Memory state(law->state_size());
  const double v = 0.05, fast = 0.156 + 0.039 * std::exp(-50.0);
  for (int i = 0; i < 200; ++i) law->commit(v, state);
  EXPECT_NEAR(law->evaluate(v, state).mu, fast, 1e-9);
  // At rest it stays, at the static level.
  law->commit(0.0, state);
  EXPECT_NEAR(law->evaluate(0.0, state).mu, 0.195, 1e-9);
  // Back by x: z = -1 + 2 exp(-x / distance).
  for (int i = 1; i <= 30; ++i) {
    const double mu = law->evaluate(-v, state).mu;
    law->commit(-v, state);
    EXPECT_NEAR(mu, fast * (2.0 * std::exp(-v * kStep * i / distance) - 1.0), 1e-9) << i;
  }
  // The slope is the derivative of the displacement part.
  const double h = 1e-7, speed = 0.2;
  const double slope =
      (law->evaluate(speed + h, state).mu - law->evaluate(speed - h, state).mu) / (2.0 * h);
  EXPECT_NEAR(law->evaluate(speed, state).slope, slope, 1e-4 * slope);
}

TEST(EyeletPresliding, DistancesOfSeveralPlacesAddUp) {
  const auto law_of = [](const std::vector<EffectInstance>& effects) {
    const auto robot = robot_with(kArm, effects);
    return robot->muscles[robot->find_muscle("brachialis")].path->obstacles()[1].friction;
  };
  const EffectInstance all = {"eyelet_presliding", "all", {{"distance", 1e-3}}};
  const EffectInstance muscle = {"eyelet_presliding", "brachialis", {{"distance", 1e-4}}};
  const EffectInstance eyelet = {"eyelet_presliding", "brachialis/1", {{"distance", 4e-4}}};
  const std::pair<std::vector<EffectInstance>, double> cases[] = {
      {{all, muscle}, 1.1e-3}, {{muscle, eyelet}, 5e-4}, {{all, muscle, eyelet}, 1.5e-3}};
  for (const auto& [effects, distance] : cases) {
    const auto law = law_of(effects);
    ASSERT_EQ(law->state_size(), 1u);
    Memory state(1);
    const double back = 0.5, level = 0.156;  // fast, at the kinetic level
    for (int i = 0; i < 2000; ++i) law->commit(0.05, state);
    const double mu = law->evaluate(-back, state).mu;
    EXPECT_NEAR(mu, level * (2.0 * std::exp(-back * kStep / distance) - 1.0), 1e-9) << distance;
  }
}

/// Work that a law takes over three periods of a motion, the first of which only bends it, per
/// tension and angle.  @param speed of the phase, 0 to 1 [m/s]
double work_taken(const FrictionLaw& law, const std::function<double(double)>& speed) {
  Memory state(law.state_size());
  double work = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const double v = speed(i % 1000 / 1000.0);
    if (i >= 1000) work += law.evaluate(v, state).mu * v * kStep;
    law.commit(v, state);
  }
  return work;
}

/// The same for strokes between -reach and reach, slow while friction gives back what has bent and
/// fast while it takes: the least work of all motions where friction falls with speed.
double least_work(const FrictionLaw& law, double reach) {
  const double slow = 1e-4, fast = 0.05;
  Memory state(law.state_size());
  double work = 0.0, at = 0.0;
  for (int stroke = 0; stroke < 12; ++stroke) {
    const double side = stroke % 2 == 0 ? 1.0 : -1.0;
    while ((reach - side * at) > 1e-12) {
      const double most = side * law.evaluate(0.0, state).mu < 0.0 ? slow : fast;
      const double v = side * std::min(most, (reach - side * at) / kStep);
      if (stroke >= 2) work += law.evaluate(v, state).mu * v * kStep;
      law.commit(v, state);
      at += v * kStep;
    }
  }
  return work;
}

TEST(SlidingFriction, NeverGivesEnergyOverACycle) {
  const double distance = 5e-4;
  const EffectInstance raised = {"eyelet_friction", "all", {{"mu", 0.2}, {"rest_ratio", 2.0}}};
  const std::vector<EffectInstance> cases[] = {
      {{"eyelet_friction", "all", {{"mu", 0.2}}}},
      {raised},
      {{"eyelet_presliding", "all", {{"distance", distance}}}},
      {{"eyelet_presliding", "all", {{"distance", distance}}}, raised}};
  for (const auto& effects : cases) {
    for (const char* file : {kRig, kArm}) {
      const auto law = robot_with(file, effects)->muscles[0].path->obstacles()[1].friction;
      for (const double reach : {1e-4, 1e-3, 1e-2}) {
        SCOPED_TRACE(effects.back().id + " " + file + " " + std::to_string(reach));
        EXPECT_GT(work_taken(*law,
                             [&](double phase) {
                               return 2.0 * M_PI * reach * std::cos(2.0 * M_PI * phase);
                             }),
                  0.0);
        // There fast and back slowly, and the other way round.
        for (const double there : {0.1, 0.9}) {
          EXPECT_GT(work_taken(*law,
                               [&](double phase) {
                                 return phase < there ? 2.0 * reach / there
                                                      : -2.0 * reach / (1.0 - there);
                               }),
                    0.0);
        }
        // Small reversals on the way.
        EXPECT_GT(work_taken(*law,
                             [&](double phase) {
                               return 2.0 * M_PI * reach *
                                      (std::cos(2.0 * M_PI * phase) +
                                       2.0 * std::cos(14.0 * M_PI * phase + 1.0));
                             }),
                  0.0);
      }
      // Presliding with less of a stroke than half the distance may give some: docs/effects.md.
      for (const double reach : {0.5 * distance, distance, 4.0 * distance}) {
        EXPECT_GT(least_work(*law, reach), 0.0) << effects.back().id << " " << file << " " << reach;
      }
    }
  }
}

TEST(WrappingSurface, TurnsTheStraightRigIntoTheWrappedOne) {
  const auto built = robot_with(kRig, {{"wrapping_surface", "flexor", {{"radius", 0.018}}},
                                       {"wrapping_surface", "extensor/2", {{"radius", 0.018}}}});
  Simulation with(built), wrapped(load_robot_model(config("two_muscle_rig/model_II.yaml"))),
      straight(load_robot_model(config(kRig)));
  double largest = 0.0;
  for (double q = -1.5; q <= 1.5; q += 0.1) {
    for (Simulation* sim : {&with, &wrapped, &straight}) sim->place({q}, {0.0, 0.0});
    for (int m = 0; m < 2; ++m) {
      EXPECT_NEAR(with.muscle(m).length(), wrapped.muscle(m).length(), 1e-12);
      EXPECT_NEAR(with.moment_arms(m)[0], wrapped.moment_arms(m)[0], 1e-12);
      largest = std::max(largest, wrapped.muscle(m).length() - straight.muscle(m).length());
    }
  }
  EXPECT_GT(largest, 0.005);
  const EffectParameter radius =
      find_effect("wrapping_surface")->parameters_at(straight.model(), "flexor")[0];
  EXPECT_NEAR(radius.bounds.hi, std::hypot(0.02, 0.08), 1e-12);  // the insertion's distance
}

TEST(WrappingSurface, MovesSegmentsBehindItUp) {
  const auto robot = robot_with("anthrob/model_I.yaml",
                                {{"wrapping_surface", "lateral_deltoid", {{"radius", 0.0127}}}});
  const auto with = robot->muscles[robot->find_muscle("lateral_deltoid")];
  EXPECT_EQ(with.path->obstacles().size(), 5u);
  EXPECT_EQ(with.spring_segment, 1);
  EXPECT_EQ(with.sensor_segment, 0);
  // Model II of the thesis has it on the same line.
  const auto two = load_robot_model(config(kArm));
  Simulation a(robot), b(two);
  const std::vector<double> q = {std::cos(0.4), 0.0, 0.0, std::sin(0.4), 0.5};
  a.place(q, std::vector<double>(11, 0.0));
  b.place(q, std::vector<double>(11, 0.0));
  EXPECT_NEAR(a.muscle(0).length(), b.muscle(0).length(), 5e-4);
}

TEST(ViaPointShift, MovesOnePointAlongItsAxis) {
  const auto plain = load_robot_model(config(kRig));
  const auto robot = robot_with(kRig, {{"via_point_shift", "flexor/2/z", {{"shift", 0.01}}}});
  Simulation before(plain), after(robot);
  const Vec3 moved = after.muscle(0).path().segments().back().to_W -
                     before.muscle(0).path().segments().back().to_W;
  EXPECT_NEAR((moved - Vec3(0, 0, 0.01)).norm(), 0.0, 1e-12);
  EXPECT_EQ(after.muscle(1).length(), before.muscle(1).length());
}

TEST(ViaPointShift, AxesAreThoseOfTheLinkThatTheFileNames) {
  // `base` stands turned by 45 degrees on the body that it is a part of.
  Simulation before(load_robot_model(config(kArm)));
  Simulation after(
      robot_with(kArm, {{"via_point_shift", "biceps_brachii/0/x", {{"shift", 0.01}}}}));
  const int muscle = after.model().find_muscle("biceps_brachii");
  const Vec3 moved = after.muscle(muscle).path().segments().front().from_W -
                     before.muscle(muscle).path().segments().front().from_W;
  const Vec3 x = after.link_pose(after.model().skeleton->find_frame("base")).R.col(0);
  ASSERT_LT(x.x(), 0.9);
  EXPECT_NEAR((moved - 0.01 * x).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace anthrob
