#include "twin/forward_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "twin/moving_robot.h"

namespace anthrob {
namespace twin {
namespace {

/// A robot that has moved for a while beside its twins.
class AfterMotion : public testing::Test {
 protected:
  void SetUp() override {
    robot.run(8.0);
    robot.stopped = true;
  }

  /// Of the robot itself, under the same orders.
  double hinge_of_robot_after(double duration, const std::vector<Order>& orders) {
    for (const Order& order : orders) robot.sim.command(order.muscle, order.mode, order.reference);
    robot.sim.step(static_cast<int>(std::lround(duration / robot.sim.step_length())));
    return robot.sim.configuration()[0];
  }

  MovingRobot robot{noisy_robot(rig_file()), *noisy_robot(rig_file())};
};

TEST_F(AfterMotion, RobotDoesWhatWasPredicted) {
  const std::vector<Order> orders = {{0, ecu::Mode::kPosition, 3.0},
                                     {1, ecu::Mode::kPosition, 0.5}};
  const auto ahead = present(robot.twins);
  const double before = ahead->configuration()[0];
  std::vector<double> times;
  const auto crossings =
      run_ahead(*ahead, {orders, false, 1.0, 10.0}, [&](double t) { times.push_back(t); });
  EXPECT_TRUE(crossings.empty());
  ASSERT_EQ(times.size(), 10u);
  EXPECT_NEAR(times[2], 0.3, 1e-9);
  EXPECT_NEAR(times.back(), 1.0, 1e-9);
  // The twins are some 10 ms behind, and know the posture to the noise of its sensor, 0.002 rad.
  const double after = hinge_of_robot_after(1.0, orders);
  EXPECT_GT(std::abs(after - before), 0.1);
  EXPECT_NEAR(ahead->configuration()[0], after, 0.005);
}

TEST_F(AfterMotion, MusclesThatAreNotNamedKeepTheirCommand) {
  const auto ahead = present(robot.twins);
  run_ahead(*ahead, {{}, false, 0.5, 0.0}, [](double) {});
  EXPECT_NEAR(ahead->configuration()[0], hinge_of_robot_after(0.5, {}), 0.005);
}

TEST_F(AfterMotion, LimitsThatWillBeCrossedAreTold) {
  const auto ahead = present(robot.twins);
  int looks = 0;
  const auto crossings = run_ahead(*ahead,
                                   {{{0, ecu::Mode::kVoltage, 12.0}, {1, ecu::Mode::kVoltage, 0.0}},
                                    false, 8.0, 0.0},
                                   [&](double) { ++looks; });
  EXPECT_EQ(looks, 1);
  ASSERT_FALSE(crossings.empty());
  double time = 0.0;
  for (const Crossing& crossing : crossings) {
    EXPECT_GE(crossing.time, time);
    EXPECT_GT(std::abs(crossing.value), std::abs(crossing.limit)) << crossing.text();
    time = crossing.time;
  }
  // The robot itself gets there, and not earlier.
  robot.sim.command(0, ecu::Mode::kVoltage, 12.0);
  robot.sim.command(1, ecu::Mode::kVoltage, 0.0);
  const auto beyond = [&] {
    return std::abs(robot.sim.configuration()[0]) > 2.0 || robot.sim.reading(0).force > 100.0;
  };
  double reached = 0.0;
  for (; reached < 8.0 && !beyond(); reached += robot.sim.step_length()) robot.sim.step();
  EXPECT_NEAR(reached, crossings.front().time, 0.1) << crossings.front().text();
}

TEST_F(AfterMotion, WhatIsLimpStaysSoUntilItIsEnabled) {
  for (int m = 0; m < 2; ++m) robot.sim.muscle_inputs().set_enabled(m, false);
  robot.run(1.0);
  const std::vector<Order> orders = {{0, ecu::Mode::kPosition, 3.0}};
  const auto limp = present(robot.twins), awake = present(robot.twins);
  run_ahead(*limp, {orders, false, 1.0, 0.0}, [](double) {});
  run_ahead(*awake, {orders, true, 1.0, 0.0}, [](double) {});
  EXPECT_LT(limp->muscle(0).measured().position, 2.5);
  EXPECT_NEAR(awake->muscle(0).measured().position, 3.0, 0.1);
}

TEST(Present, IsNotKnownOfARobotThatWasLost) {
  const auto model = noisy_robot(rig_file());
  const Twins twins(*model, TwinOptions{});
  EXPECT_THROW(present(twins), BadInput);
}

TEST(Crossing, SaysWhatWhereAndWhen) {
  EXPECT_EQ((Crossing{"elbow", "position", "rad", 1.94, 1.8, 0.4}.text()),
            "elbow: position of 1.94 rad, beyond 1.8 rad from 0.4 s on");
}

}  // namespace
}  // namespace twin
}  // namespace anthrob
