// Effects from the controller to the motor's terminals, each against a closed form.
#include <gtest/gtest.h>

#include "effects_support.h"

namespace anthrob {
namespace {

using namespace testing_support;

const char* const kRig = "two_muscle_rig/model_I.yaml";

TEST(CommandLatency, CommandsArriveAfterTheDelay) {
  const auto robot = robot_with(kRig, {{"command_latency", "flexor", {{"delay", 0.0045}}}});
  Simulation sim(robot);
  sim.command(0, ecu::Mode::kVoltage, 2.0);
  sim.command(1, ecu::Mode::kVoltage, 2.0);
  std::vector<double> volts;
  for (int i = 0; i < 7; ++i) {
    sim.step();
    volts.push_back(sim.muscle(0).voltage());
    EXPECT_EQ(sim.muscle(1).voltage(), 2.0);
  }
  const std::vector<double> expected = {0, 0, 0, 0, 1.0, 2.0, 2.0};
  for (std::size_t i = 0; i < volts.size(); ++i) EXPECT_NEAR(volts[i], expected[i], 1e-9) << i;
}

TEST(CommandLatency, WhatStopsForgetsWhatIsOnItsWay) {
  const auto robot = robot_with(kRig, {{"command_latency", "flexor", {{"delay", 0.1}}}});
  Simulation sim(robot);
  sim.command(0, ecu::Mode::kVoltage, 2.0);
  sim.step(150);
  ASSERT_EQ(sim.muscle(0).voltage(), 2.0);
  sim.muscle_inputs().set_enabled(0, false);
  sim.step(2);
  sim.muscle_inputs().set_enabled(0, true);
  sim.command(0, ecu::Mode::kVoltage, 0.5);
  for (int i = 0; i < 150; ++i) {
    sim.step();
    EXPECT_LE(sim.muscle(0).voltage(), 0.5);
  }
  EXPECT_EQ(sim.muscle(0).voltage(), 0.5);
}

TEST(CommandLatency, AStopBetweenTwoStepsForgetsItTooAndTheControllersMemory) {
  const auto robot = robot_with(kRig, {{"command_latency", "flexor", {{"delay", 0.1}}}});
  Simulation sim(robot);
  sim.command(0, ecu::Mode::kPosition, 1.0);
  sim.step(150);
  const auto stop = [&sim](int muscle) {
    sim.muscle_inputs().set_enabled(muscle, false);
    sim.muscle_inputs().set_enabled(muscle, true);
    sim.command(muscle, ecu::Mode::kVoltage, 0.0);
  };
  ASSERT_NE(sim.muscle(0).voltage(), 0.0);
  stop(0);
  for (int i = 0; i < 120; ++i) {
    sim.step();
    EXPECT_EQ(sim.muscle(0).voltage(), 0.0) << i;
  }
  // Without the effect: what the integral of FORCE mode has gathered does not go on.
  sim.command(1, ecu::Mode::kForce, 30.0);
  sim.step(300);
  Simulation going_on(robot);
  going_on.restore(sim.snapshot());
  stop(1);
  sim.command(1, ecu::Mode::kForce, 30.0);
  sim.step();
  going_on.step();
  EXPECT_GT(std::abs(going_on.muscle(1).voltage() - sim.muscle(1).voltage()), 0.02);
}

TEST(CommandLatency, AChangeOfModeIsNoBlendOfTwoQuantities) {
  const auto robot = robot_with(kRig, {{"command_latency", "flexor", {{"delay", 0.0044}}}});
  Simulation sim(robot);
  sim.command(0, ecu::Mode::kPosition, 20.0);
  sim.step(20);
  sim.command(0, ecu::Mode::kVoltage, 1.0);
  sim.step(4);
  ASSERT_EQ(sim.muscle(0).voltage(), 12.0) << "not there yet";
  for (int i = 0; i < 3; ++i) {
    sim.step();
    EXPECT_EQ(sim.muscle(0).voltage(), 1.0) << i;
  }
}

TEST(CommandLatency, AVoltagePastItIsThereAtOnceAndNoOlderCommandComesAfterIt) {
  const auto robot = robot_with(kRig, {{"command_latency", "flexor", {{"delay", 0.05}}}});
  Simulation sim(robot);
  sim.command(0, ecu::Mode::kPosition, 1.0);
  sim.step(200);
  sim.muscle_inputs().apply_voltage(0, 3.0);
  sim.step();
  EXPECT_EQ(sim.muscle(0).voltage(), 3.0);
  sim.step(300);
  sim.muscle_inputs().release(0);
  sim.command(0, ecu::Mode::kVoltage, 1.0);
  for (int i = 0; i < 100; ++i) {
    sim.step();
    EXPECT_EQ(sim.muscle(0).voltage(), i < 50 ? 3.0 : 1.0) << i;
  }
}

TEST(PwmDeadZone, TakesAConstantPartOfTheVoltage) {
  const auto robot = robot_with(kRig, {{"pwm_dead_zone", "flexor", {{"width", 0.3}}}});
  ASSERT_EQ(robot->power_effects.size(), 1u);
  const auto through = [&](double volts) {
    std::vector<PowerLine> lines = {{volts, 0.1}, {volts, 0.1}};
    robot->power_effects[0]->apply(lines, StateView());
    EXPECT_EQ(lines[1].voltage, volts);
    return lines[0].voltage;
  };
  EXPECT_DOUBLE_EQ(through(0.2), 0.0);
  EXPECT_DOUBLE_EQ(through(-0.2), 0.0);
  EXPECT_DOUBLE_EQ(through(1.0), 0.7);
  EXPECT_DOUBLE_EQ(through(-1.0), -0.7);
  // In the chain: 1 V with the dead zone moves the motor as 0.7 V without.
  Simulation dead(robot), plain(load_robot_model(config(kRig)));
  dead.command(0, ecu::Mode::kVoltage, 1.0);
  plain.command(0, ecu::Mode::kVoltage, 0.7);
  dead.step(300), plain.step(300);
  EXPECT_NEAR(dead.muscle(0).actuator().position, plain.muscle(0).actuator().position, 1e-9);
}

TEST(SupplySag, SharesTheVoltageLostByTheSumOfCurrents) {
  const auto robot = robot_with(kRig, {{"supply_sag", "ecu_1", {{"resistance", 0.2}}}});
  const PowerEffect& supply = *robot->power_effects.at(0);
  Memory memory(supply.state_size());
  const StateView before = memory;
  // d = 1/2 and -1/4 of 12 V: the supply gives 0.5 + 0.125 A and loses 0.125 V. Currents that go on
  // as they are: the motors had these voltages before.
  const double current = 0.625, left = 12.0 - 0.2 * current;
  before[0] = 0.5 * left;
  before[1] = -0.25 * left;
  std::vector<PowerLine> lines = {{6.0, 1.0}, {-3.0, -0.5}};
  supply.apply(lines, before);
  EXPECT_NEAR(lines[0].voltage, 0.5 * left, 1e-12);
  EXPECT_NEAR(lines[1].voltage, -0.25 * left, 1e-12);
  // Energy: what the nominal supply gives is what the motors get and R I^2.
  const double motors = lines[0].voltage * 1.0 + lines[1].voltage * -0.5;
  EXPECT_NEAR(12.0 * current - motors, 0.2 * current * current, 1e-12);
}

TEST(SupplySag, DoesNotCountAMotorThatIsMovedFromOutside) {
  const auto robot = robot_with(kRig, {{"supply_sag", "ecu_1", {{"resistance", 2.0}}}});
  const auto turned = [&](bool beside) {
    Simulation sim(robot);
    for (int m = 0; m < 2; ++m) sim.command(m, ecu::Mode::kVoltage, beside || m == 0 ? 6.0 : 0.0);
    sim.step(5);  // both draw
    sim.muscle_inputs().impose_position(1, 0.0, 0.0);
    sim.step(200);
    EXPECT_EQ(sim.reading(1).current, 0.0);
    return sim.muscle(0).actuator().velocity;
  };
  EXPECT_NEAR(turned(true), turned(false), 1e-3 * std::abs(turned(false)));
}

TEST(SupplySag, CountsTheMotorsOfItsEcuOrAllOfThem) {
  for (const char* place : {"ecu_1", "ecu_3", "global"}) {
    const auto robot =
        robot_with("anthrob/model_II.yaml", {{"supply_sag", place, {{"resistance", 0.2}}}});
    const PowerEffect& supply = *robot->power_effects.at(0);
    const std::size_t count = robot->muscles.size();
    std::vector<PowerLine> lines(count);
    std::vector<bool> counts(count);
    double current = 0.0;
    std::size_t users = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double duty = 0.1 + 0.07 * static_cast<double>(i);
      lines[i] = {12.0 * duty, 0.3 + 0.1 * static_cast<double>(i)};
      counts[i] = place == std::string("global") || place == robot->muscles[i].ecu;
      if (counts[i]) current += duty * lines[i].current, ++users;
    }
    ASSERT_GT(users, 1u) << place;
    ASSERT_EQ(users == count, place == std::string("global"));
    // Currents that go on as they are: the motors had these voltages before.
    const double left = 1.0 - 0.2 * current / 12.0;
    ASSERT_EQ(supply.state_size(), users);
    Memory memory(users);
    for (std::size_t i = 0, user = 0; i < count; ++i) {
      if (counts[i]) memory.at(user++) = left * lines[i].voltage;
    }
    const std::vector<PowerLine> asked = lines;
    supply.apply(lines, memory);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_NEAR(lines[i].voltage, (counts[i] ? left : 1.0) * asked[i].voltage, 1e-12)
          << robot->muscles[i].name << " " << place;
    }
  }
}

TEST(SupplySag, HasTheWholeRobotForAPlaceWhereNoEcuIsNamed) {
  const std::string file = "rig_ecu_load/model_I.yaml";
  const auto robot = robot_with(file, {{"supply_sag", "global", {{"resistance", 0.2}}}}, 1e-4);
  EXPECT_EQ(find_effect("supply_sag")->places(*robot), std::vector<std::string>{"global"});
  EXPECT_EQ(robot->power_effects.at(0)->state_size(), 1u);
  EXPECT_TRUE(find_effect("supply_sag")
                  ->places(*load_robot_model(config("driven_axis/model_I.yaml")))
                  .empty());
}

TEST(SupplySag, ALargeResistanceIsADividerAndDoesNotSwing) {
  // Both motors of the rig stalled at the same share of a supply of more resistance than theirs:
  // their currents follow their voltages in 60 us.
  const double supply = 8.0, motor = 4.69 + 0.12, duty = 0.9, asked = 12.0 * duty;
  const auto robot = robot_with(kRig, {{"supply_sag", "ecu_1", {{"resistance", supply}}}});
  const PowerEffect& sag = *robot->power_effects.at(0);
  Memory state(sag.state_size());
  // V = d (V_0 - R 2 d i), i = V / R_motor
  const double expected = asked / (1.0 + 2.0 * duty * duty * supply / motor);
  double volts = 0.0;
  for (int i = 0; i < 50; ++i) {
    const double current = volts / motor;
    std::vector<PowerLine> lines = {{asked, current}, {asked, current}};
    sag.apply(lines, state);
    volts = lines[0].voltage;
    EXPECT_NEAR(volts, expected, 1e-6 * expected) << i;
    EXPECT_EQ(lines[1].voltage, volts);
  }
}

}  // namespace
}  // namespace anthrob
