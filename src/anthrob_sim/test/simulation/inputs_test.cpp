// What drives a simulation beside commands: gains, voltages, imposed motions of muscles and joints.
#include "anthrob_sim/inputs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/moving_arm.h"

namespace anthrob {
namespace {

using testing_support::anthrob_model;
using testing_support::config;
using testing_support::excite;
using testing_support::swing;

TEST(Simulation, AnImposedHingeArrivesAlsoBeyondHalfATurn) {
  Simulation sim(load_robot_model(testing_support::config("two_muscle_rig/model_I.yaml")));
  for (const double angle : {3.5, -8.0}) {
    sim.imposed_posture().impose({angle});
    sim.step();
    EXPECT_NEAR(sim.configuration()[0], angle, 1e-9);
    sim.step();
    EXPECT_NEAR(sim.configuration()[0], angle, 1e-9);
    EXPECT_NEAR(sim.read_velocity(0), 0.0, 1e-6);
  }
}

TEST(Simulation, AnImposedPostureIsArrivedAtWhateverPulls) {
  Simulation sim(anthrob_model("II"));
  sim.place(swing(0.0), std::vector<double>(11, 0.0));
  excite(sim);
  const double h = sim.step_length();
  for (int i = 1; i <= 600; ++i) {
    sim.imposed_posture().impose(swing(i * h));
    sim.step();
    const std::vector<double> wanted = swing(i * h);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      ASSERT_NEAR(sim.configuration()[k], wanted[k], 1e-12) << i << " " << k;
    }
    // Of that step, backwards.
    const double rate = (wanted[4] - swing((i - 1) * h)[4]) / h;
    ASSERT_NEAR(sim.read_velocity(1), rate, 1e-9) << i;
    const Vec3 turning =
        0.4 * (std::sin(3.0 * i * h) - std::sin(3.0 * (i - 1) * h)) / h * Vec3(0.6, 0.0, 0.8);
    ASSERT_LT((sim.read_ball_velocity(0) - turning).norm(), 1e-9) << i;
  }
  EXPECT_GT(sim.muscle(0).spring_tension(), 1.0);  // muscles pull all the while
  const std::vector<double> there = sim.configuration();
  sim.step(100);  // and stays, until it is released
  EXPECT_NEAR(sim.read_velocity(1), 0.0, 1e-9);
  EXPECT_NEAR(sim.configuration()[4], there[4], 1e-12);
  sim.imposed_posture().release();
  sim.step(100);
  EXPECT_GT(std::abs(sim.configuration()[4] - there[4]), 1e-3);
}

TEST(Simulation, APostureThatIsNoneIsRefused) {
  Simulation sim(anthrob_model("I"));
  EXPECT_THROW(sim.imposed_posture().impose({1, 0, 0, 0}), BadInput);
  EXPECT_THROW(sim.imposed_posture().impose({1, 0, 0, 0, std::nan("")}), BadInput);
  EXPECT_THROW(sim.imposed_posture().impose({0, 0, 0, 0, 0}), BadInput);
}

TEST(Simulation, DisabledMuscleGetsZeroVolts) {
  Simulation sim(anthrob_model("I"));
  sim.command(0, ecu::Mode::kVoltage, 6.0);
  sim.step(50);
  EXPECT_EQ(sim.muscle(0).voltage(), 6.0);
  sim.muscle_inputs().set_enabled(0, false);
  sim.step(1);
  EXPECT_EQ(sim.muscle(0).voltage(), 0.0);
}

TEST(Simulation, AGainCountsFromTheNextTickOn) {
  Simulation sim(anthrob_model("I")), plain(anthrob_model("I"));
  for (Simulation* each : {&sim, &plain}) {
    each->command(0, ecu::Mode::kPosition, 1.0);
    each->step(50);
  }
  EXPECT_EQ(sim.muscle(0).voltage(), plain.muscle(0).voltage());
  sim.muscle_inputs().set_gain(0, ecu::Parameter::kPositionDerivative, 0.0);
  sim.muscle_inputs().set_gain(0, ecu::Parameter::kPositionForceFeedforward, 0.0);
  sim.muscle_inputs().set_gain(0, ecu::Parameter::kPositionProportional, 0.5);
  const double seen = sim.muscle(0).measured().position;
  sim.step(1);
  EXPECT_EQ(sim.muscle(0).voltage(), 0.5 * (1.0 - seen));
  EXPECT_EQ(sim.muscle(1).controller().position.proportional,
            plain.muscle(1).controller().position.proportional);
  sim.reset();
  EXPECT_EQ(sim.muscle(0).controller().position.proportional, 0.5);
  EXPECT_THROW(sim.muscle_inputs().set_gain(0, ecu::Parameter::kVoltageLimit, 1.0), BadInput);
  EXPECT_THROW(sim.muscle_inputs().set_gain(0, ecu::Parameter::kPositionProportional, -1.0),
               BadInput);
  EXPECT_THROW(sim.muscle_inputs().set_gain(0, ecu::Parameter::kPositionProportional, std::nan("")),
               BadInput);
  Simulation hill(load_robot_model(testing_support::config("two_muscle_rig/model_hill.yaml")));
  EXPECT_THROW(hill.muscle_inputs().set_gain(0, ecu::Parameter::kPositionProportional, 1.0),
               BadInput);
}

TEST(Simulation, ImposedPositionIsTakenExactly) {
  Simulation sim(anthrob_model("I"));
  for (int i = 1; i <= 100; ++i) {
    sim.muscle_inputs().impose_position(3, 0.01 * i, 10.0);
    sim.step();
    EXPECT_EQ(sim.muscle(3).actuator().position, 0.01 * i);
  }
  sim.muscle_inputs().release(3);
  sim.step(10);
  EXPECT_NE(sim.muscle(3).actuator().position, 1.0);
}

TEST(Simulation, AVoltageThatIsAppliedDoesNotWaitForTheController) {
  Simulation sim(load_robot_model(config("rig_oring_stretcher/model_I.yaml")));
  ASSERT_EQ(sim.model().muscles[0].steps_per_tick, 2);
  for (int i = 1; i <= 6; ++i) {
    sim.muscle_inputs().apply_voltage(0, 0.1 * i);
    sim.step();
    EXPECT_EQ(sim.muscle(0).voltage(), 0.1 * i);
  }
}

}  // namespace
}  // namespace anthrob
