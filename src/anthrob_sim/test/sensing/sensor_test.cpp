// Sensor imperfections and the counter-based random numbers behind them.
#include "anthrob_sim/sensing/sensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "anthrob_sim/simulation.h"
#include "support.h"

namespace anthrob {
namespace {

class Instrument {
 public:
  explicit Instrument(const SensorModel& model, std::uint64_t stream = 0, int steps_per_tick = 1)
      : sensor_(model, 7, stream, 1e-3, steps_per_tick), memory_(sensor_.state_size() + 1, 0.0) {
    sensor_.reset(0.0, StateView(memory_.data()));
  }
  double measure(double value) {
    return sensor_.measure(value, index_++, StateView(memory_.data()));
  }

 private:
  Sensor sensor_;
  std::vector<double> memory_;
  std::uint64_t index_ = 0;
};

TEST(Sensor, IdealByDefault) {
  Instrument sensor{SensorModel()};
  for (double x : {1.0, -3.25, 1e-9}) EXPECT_EQ(sensor.measure(x), x);
}

TEST(Sensor, DelayIsInWholeSteps) {
  SensorModel model;
  model.delay = 0.005;
  Instrument sensor(model);
  for (int i = 1; i <= 20; ++i) EXPECT_EQ(sensor.measure(i), i <= 5 ? 0.0 : i - 5.0);
}

TEST(Sensor, QuantumRoundsToCounts) {
  SensorModel model;
  model.quantum = 0.25;
  Instrument sensor(model);
  EXPECT_EQ(sensor.measure(0.30), 0.25);
  EXPECT_EQ(sensor.measure(-0.40), -0.5);
}

TEST(Sensor, NoiseIsNormalAndWhite) {
  SensorModel model;
  model.noise = 0.1;
  Instrument sensor(model);
  const int n = 200000;
  double sum = 0.0, squares = 0.0, product = 0.0, fourth = 0.0, last = 0.0;
  for (int i = 0; i < n; ++i) {
    const double e = sensor.measure(0.0) / 0.1;
    sum += e, squares += e * e, product += e * last, fourth += e * e * e * e;
    last = e;
  }
  EXPECT_NEAR(sum / n, 0.0, 4 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1.0, 4 * std::sqrt(2.0 / n));
  EXPECT_NEAR(product / n, 0.0, 4 / std::sqrt(n));
  EXPECT_NEAR(fourth / n, 3.0, 4 * std::sqrt(96.0 / n));
}

TEST(Sensor, StreamsAreIndependentAndRepeatable) {
  SensorModel model;
  model.noise = 1.0;
  Instrument a(model, 1), b(model, 2), again(model, 1);
  double product = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double x = a.measure(0.0);
    product += x * b.measure(0.0);
    ASSERT_EQ(again.measure(0.0), x);
  }
  EXPECT_NEAR(product / 100000, 0.0, 4 / std::sqrt(100000.0));
}

/// The rig with other sensors and effects, tendons hanging slack; what is measured of the flexor.
std::vector<double> forces_of_a_slack_tendon(const std::string& more) {
  const std::string rig = testing_support::config("two_muscle_rig/");
  const testing_support::TemporaryRobot robot(
      "", "extends: " + rig + "model_I.yaml\nrobot: " + rig + "robot.urdf\n" + more);
  Simulation sim(robot.load());
  sim.place(sim.configuration(), {-5.0, -5.0});
  std::vector<double> forces;
  for (int i = 0; i < 1000; ++i) {
    sim.step();
    EXPECT_EQ(sim.muscle(0).force(), 0.0);
    forces.push_back(sim.muscle(0).measured().force);
  }
  return forces;
}

TEST(Sensor, AMeasuredForceIsNeverNegative) {
  const auto noisy = forces_of_a_slack_tendon("sensors:\n  force: {noise: 0.5}\n");
  const auto zeros = std::count(noisy.begin(), noisy.end(), 0.0);
  EXPECT_NEAR(zeros, 500, 100);  // the other half is above
  EXPECT_EQ(*std::min_element(noisy.begin(), noisy.end()), 0.0);
  const auto low = forces_of_a_slack_tendon(
      "effects:\n  - {id: force_sensor_offset, place: all, offset: -2.0}\n");
  EXPECT_EQ(low, std::vector<double>(1000, 0.0));
  const auto high = forces_of_a_slack_tendon(
      "effects:\n  - {id: force_sensor_offset, place: all, offset: 2.0}\n");
  EXPECT_EQ(high, std::vector<double>(1000, 2.0));
}

TEST(Sensor, AverageIsAMovingMean) {
  SensorModel model;
  model.average = 4;
  Instrument sensor(model);
  EXPECT_DOUBLE_EQ(sensor.measure(4.0), 4.0);
  EXPECT_DOUBLE_EQ(sensor.measure(8.0), 6.0);
  sensor.measure(0.0);
  EXPECT_DOUBLE_EQ(sensor.measure(0.0), 3.0);
  EXPECT_DOUBLE_EQ(sensor.measure(0.0), 2.0);
}

TEST(Sensor, AverageCountsTicksWhateverTheStep) {
  SensorModel model;
  model.average = 4;
  Instrument coarse(model), fine(model, 0, 5);
  for (int tick = 0; tick < 30; ++tick) {
    const double seen = coarse.measure(tick * tick);
    for (int step = 0; step < 5; ++step) {
      // What comes between the ticks is not seen.
      EXPECT_EQ(fine.measure(step == 0 ? tick * tick : -1e6), seen) << tick << " " << step;
    }
  }
}

/// What the ECU reads while a motor turns at 1 rad/s, 9.5 ticks behind: half of the 20 averaged.
TEST(Sensor, AveragesOfAModelLagByTheSameTimeAtAnyStep) {
  const std::string rig = testing_support::config("two_muscle_rig/");
  const testing_support::TemporaryRobot robot(
      "", "extends: " + rig + "model_I.yaml\nrobot: " + rig +
              "robot.urdf\nsensors:\n  position: {average: 20}\n");
  for (const double step : {1e-3, 5e-4, 1e-4}) {
    Simulation sim(robot.load(step));
    const int steps = static_cast<int>(std::lround(0.1 / step));
    for (int i = 1; i <= steps; ++i) {
      sim.muscle_inputs().impose_position(0, i * step, 1.0);
      sim.step();
    }
    EXPECT_NEAR(sim.muscle(0).actuator().position, 0.1, 1e-9);
    EXPECT_NEAR(sim.muscle(0).measured().position, 0.1 - 0.0095, 1e-9) << step;
  }
}

}  // namespace
}  // namespace anthrob
