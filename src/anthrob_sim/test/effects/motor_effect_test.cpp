// Effects of power stage, motor, gear and spindle, each against a closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_sim/actuator/dc_motor.h"
#include "effects_support.h"

namespace anthrob {
namespace {

using namespace testing_support;

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

TEST(WindingHeating, CoolsWhereTheMotorIsMovedFromOutside) {
  const double rise = 60.0, volts = 1.6, hold = Winding::kHold;
  const EffectInstance effect = {
      "winding_heating", "flexor", {{"thermal_resistance", rise}, {"time_constant", 1.0}}};
  Bench cooled(effect);
  const double warm = Winding::warmth(cooled.run(volts, hold, 5000).read().current, volts);
  EXPECT_GT(cooled.read().current, 0.1);
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

/// Largest amplitude of the rig's motor that is accepted [Nm].
double largest_cogging(double periods) {
  return 1.2 * 4.6e-7 / (kStep * kStep * periods);
}

TEST(Cogging, ComesToRestUpToTheLimit) {
  for (const double periods : {25.0, 100.0, 200.0}) {
    const double amplitude = 0.98 * largest_cogging(periods);
    Bench bench({"cogging", "flexor", {{"sine", amplitude}, {"periods", periods}}});
    for (double start = 0.1; start < 2.0 * M_PI; start += 0.6) {
      // From rest, and at speeds of parts of a period in a step, with which it could keep in step.
      for (int part = 0; part <= 16; ++part) {
        const double way = 2.0 * M_PI * part / (16.0 * periods * 128.0);
        bench.place(start / (periods * 128.0) - way);
        bench.impose(start / (periods * 128.0), 0.0);
        bench.run(0.0, 0.0, 5000);
        EXPECT_LT(std::abs(bench.read().velocity), 1e-5) << periods << " " << start << " " << part;
      }
    }
  }
}

TEST(Cogging, OfTwoEntriesComesToRestUpToTheirLimit) {
  const double some = 0.4 * largest_cogging(12.0), more = 0.58 * largest_cogging(25.0);
  const auto robot =
      robot_with(kRig, {{"cogging", "all", {{"sine", some}}},
                        {"cogging", "flexor", {{"cosine", more}, {"periods", 25.0}}}});
  const Actuator& motor = *robot->muscles[robot->find_muscle("flexor")].actuator;
  Memory state(motor.state_size());
  for (int start = 0; start < 40; ++start) {
    motor.place(1e-4 * start, state);
    motor.impose(1e-4 * start, 0.1 * start, 0.0, state);
    for (int i = 0; i < 5000; ++i) motor.advance(0.0, 0.0, state);
    EXPECT_LT(std::abs(motor.read(state).velocity), 1e-5) << start;
  }
}

std::string refusal_of(const std::vector<EffectInstance>& effects) {
  try {
    robot_with(kRig, effects);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Cogging, IsRefusedBeyondTheLimitAloneOrTogether) {
  const double periods = 100.0, limit = largest_cogging(periods);
  const EffectInstance beyond = {
      "cogging", "flexor", {{"cosine", -1.01 * limit}, {"periods", periods}}};
  const std::string text = refusal_of({beyond});
  EXPECT_NE(text.find("effect cogging at flexor: cosine: -0.0055752: expected an amplitude below "
                      "0.00552 Nm, for this number of periods and this simulation step"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_NO_THROW(robot_with(kRig, {beyond}, 0.5 * kStep));

  const auto half = [&](const std::string& place) {
    return EffectInstance{"cogging", place, {{"sine", 0.51 * limit}, {"periods", periods}}};
  };
  EXPECT_NO_THROW(robot_with(kRig, {half("flexor"), half("extensor")}));
  const std::string together = refusal_of({half("flexor"), half("all")});
  EXPECT_NE(together.find("sine: 0.0028152: expected an amplitude below 0.0027048 Nm, for this "
                          "number of periods and this simulation step, beside the other cogging "
                          "of this muscle"),
            std::string::npos)
      << together;
}

TEST(MotorFriction, TakesItsCurrentAtAnySpeed) {
  const double torque = 8e-4, constant = 0.00973, ratio = 128.0, resistance = 4.81;
  for (const double volts : {3.0, 8.0, -8.0}) {
    Bench bench({"motor_friction", "flexor", {{"torque", torque}}});
    const double current = std::copysign(torque / constant, volts);
    EXPECT_NEAR(bench.run(volts, 0.0, 3000).read().current, current, 1e-6);
    EXPECT_NEAR(bench.read().velocity, (volts - resistance * current) / (constant * ratio), 1e-6);
  }
}

TEST(MotorFriction, HoldsWhatPullsLess) {
  const double torque = 8e-4, ratio = 128.0, efficiency = 0.59;
  const EffectInstance effect = {"motor_friction", "flexor", {{"torque", torque}}};
  // Driven by the tendon, the gear passes on its efficiency.
  const double limit = ratio * torque / (efficiency * kSpindleRadius);
  Bench held(effect), moved(effect), coasting(effect);
  EXPECT_EQ(held.run(0.0, 0.99 * limit, 1000).read().position, 0.0);
  EXPECT_LT(moved.run(0.0, 1.01 * limit, 1000).read().velocity, 0.0);
  EXPECT_GT(coasting.run(8.0, 0.0, 500).read().velocity, 1.0);
  EXPECT_EQ(coasting.run(0.0, 0.0, 1000).read().velocity, 0.0);
}

TEST(MotorFriction, AddsToThatOfTheModel) {
  const std::string rig = "rig_oring_stretcher/model_I.yaml";
  const std::string muscle = load_robot_model(config(rig))->muscles[0].name;
  const auto friction = [&](const std::vector<EffectInstance>& effects) {
    const auto robot = robot_with(rig, effects);
    return static_cast<const DcMotor&>(*robot->muscles[0].actuator).parameters().friction_torque;
  };
  const double model = friction({});
  ASSERT_GT(model, 0.0);
  EXPECT_NEAR(friction({{"motor_friction", muscle, {{"torque", 1e-3}}},
                        {"motor_friction", "all", {{"torque", 2e-3}}}}),
              model + 3e-3, 1e-15);
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

}  // namespace
}  // namespace anthrob
