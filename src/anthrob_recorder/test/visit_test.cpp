// Visits to postures: as a table of steps, and with the simulated robot.
#include "visit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_sim/simulation.h"
#include "support.h"

namespace anthrob {
namespace {

using testing_support::anthrob_folder;
using testing_support::standing;
using testing_support::tier1;

constexpr double kTick = 0.01;

class VisitTest : public ::testing::Test {
 protected:
  void load(const std::string& name) {
    protocol = Protocol::load(anthrob_folder() + "record_" + name + ".yaml", model);
  }

  /// A robot that stands where it is told at once. @return the orders by number of recording
  std::vector<int> run(Visit& visit, const Protocol::Target& rest, const Protocol::Target& target,
                       double limit = 60.0) {
    std::vector<int> ticks(3, 0);
    RobotMeasurement at = standing(*model, rest);
    for (double t = 0.0; t < limit && visit.outcome() == Visit::Outcome::kRunning; t += kTick) {
      const Visit::Order order = visit.step(at, t);
      ++ticks[order.recording];
      at = standing(*model, order.aim == Visit::Aim::kRest ? rest : target);
    }
    return ticks;
  }

  std::shared_ptr<const RobotModel> model = tier1();
  Protocol protocol;
};

TEST_F(VisitTest, AForceIsTheMeanOfWhatWasMeasured) {
  load("tier1_equilibria");
  SampleMean mean(model);
  RobotMeasurement at = standing(*model, protocol.rest);
  for (const double force : {4.0, std::nan(""), 6.0}) {
    at.muscles[2].force = force;
    at.muscles[3].force = std::nan("");
    mean.add(at);
  }
  EXPECT_EQ(mean.mean(1.0).force[0], 5.0);
  EXPECT_EQ(mean.mean(1.0).force[2], 5.0);
  EXPECT_TRUE(std::isnan(mean.mean(1.0).force[3]));  // it has no sensor
}

TEST_F(VisitTest, AnEquilibriumIsRecordedFromRestToTheEndOfTheHold) {
  load("tier1_equilibria");
  Visit visit(model, protocol, nullptr);
  const auto ticks = run(visit, protocol.rest, protocol.targets[5]);
  EXPECT_EQ(visit.outcome(), Visit::Outcome::kDone) << visit.reason().value_or("");
  EXPECT_NEAR(ticks[1] * kTick, 0.5 + 0.5 + 0.5, 0.1);  // lead, settling window, hold
  EXPECT_EQ(ticks[2], 0);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(visit.target().q[k], protocol.targets[5].q[k], 1e-12);
  for (int m = 0; m < 8; ++m)
    EXPECT_NEAR(visit.target().position[m], protocol.targets[5].reference[m], 1e-12);
  EXPECT_NEAR(visit.rest_before().q[0], 1.0, 1e-12);
}

TEST_F(VisitTest, ATrajectoryIsRecordedBothWays) {
  load("tier1_trajectories");
  Visit visit(model, protocol, nullptr);
  const auto ticks = run(visit, protocol.rest, protocol.targets[3]);
  EXPECT_EQ(visit.outcome(), Visit::Outcome::kDone) << visit.reason().value_or("");
  EXPECT_NEAR(ticks[1], ticks[2], 3);
  EXPECT_GT(ticks[2], 100);
}

TEST_F(VisitTest, ZeroGravityIsRecordedOnceTheArmHangs) {
  load("tier1_zero_gravity");
  Visit visit(model, protocol, nullptr);
  const auto ticks = run(visit, protocol.rest, protocol.targets[3]);
  EXPECT_EQ(visit.outcome(), Visit::Outcome::kDone) << visit.reason().value_or("");
  EXPECT_NEAR(ticks[1] * kTick, 1.0, 0.1);
}

TEST_F(VisitTest, ZeroGravityWaitsForAControllerThatSetsOutSlowly) {
  load("tier1_zero_gravity");
  protocol.go_duration = 15.0;
  Visit visit(model, protocol, nullptr);
  RobotMeasurement at = standing(*model, protocol.rest);
  double left = 0.0;
  for (double t = 0.0; t < 200.0 && visit.outcome() == Visit::Outcome::kRunning; t += kTick) {
    const Visit::Order order = visit.step(at, t);
    if (order.aim == Visit::Aim::kRest) left = t;
    // There only at the end of its time, and nowhere before.
    if (order.aim == Visit::Aim::kTarget && t > left + 14.0) {
      at = standing(*model, protocol.targets[3]);
    }
    if (order.aim == Visit::Aim::kRest) at = standing(*model, protocol.rest);
  }
  EXPECT_EQ(visit.outcome(), Visit::Outcome::kDone) << visit.reason().value_or("");
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(visit.target().q[k], protocol.targets[3].q[k], 1e-12);
}

TEST_F(VisitTest, WhatWentWrongOutsideFailsIt) {
  load("tier1_equilibria");
  Visit visit(model, protocol, nullptr);
  visit.step(standing(*model, protocol.rest), 0.0);
  visit.fail("a motor stopped");
  EXPECT_EQ(visit.outcome(), Visit::Outcome::kFailed);
  EXPECT_EQ(visit.reason(), "a motor stopped");
  visit.fail("and another one");
  EXPECT_EQ(visit.reason(), "a motor stopped");
}

TEST_F(VisitTest, AnOperatorTakesHisTime) {
  load("tier1_zero_gravity");
  protocol.by_hand = true;
  Visit visit(model, protocol, nullptr);
  EXPECT_FALSE(visit.trigger());  // nobody has seen the robot yet
  run(visit, protocol.rest, protocol.targets[3], 300.0);
  EXPECT_EQ(visit.outcome(), Visit::Outcome::kRunning);
  EXPECT_TRUE(visit.trigger());
  run(visit, protocol.rest, protocol.targets[3], 300.0);
  EXPECT_EQ(visit.outcome(), Visit::Outcome::kDone);
}

TEST_F(VisitTest, WhatNeverSettlesFails) {
  load("tier1_equilibria");
  Visit visit(model, protocol, nullptr);
  double t = 0.0;
  for (; visit.outcome() == Visit::Outcome::kRunning && t < 100.0; t += kTick) {
    RobotMeasurement shaking = standing(*model, protocol.rest);
    shaking.muscles[2].position += 0.05 * std::sin(3.0 * t);
    visit.step(shaking, t);
  }
  EXPECT_EQ(visit.outcome(), Visit::Outcome::kFailed);
  EXPECT_NEAR(t, protocol.settle.timeout, 0.1);
  EXPECT_NE(visit.reason().value().find("not settled"), std::string::npos);
}

TEST_F(VisitTest, NoiseIsNotMotion) {
  load("tier1_equilibria");
  SettleDetector detector(model, protocol.settle);
  double t = 0.0;
  bool settled = false;
  for (int i = 0; i < 200 && !settled; ++i, t += kTick) {
    RobotMeasurement measured = standing(*model, protocol.rest);
    for (auto& muscle : measured.muscles) muscle.velocity = i % 2 ? 0.3 : -0.3;
    measured.muscles[0].position += i % 2 ? 0.003 : -0.003;
    settled = detector.step(measured, t);
  }
  EXPECT_TRUE(settled);
}

TEST_F(VisitTest, ADriftedRestPostureIsNoticedBeforeAndAfter) {
  load("tier1_equilibria");
  Visit first(model, protocol, nullptr);
  run(first, protocol.rest, protocol.targets[1]);
  Protocol::Target moved = protocol.rest;
  for (const double degrees : {2.0, 4.0}) {
    const double half = degrees * M_PI / 360.0;
    moved.q = {std::cos(half), 0.0, std::sin(half), 0.0};
    Visit later(model, protocol, &first.rest_before());
    run(later, moved, protocol.targets[2]);
    EXPECT_NEAR(later.drift(), 2.0 * half, 1e-9);
    EXPECT_EQ(later.outcome(), degrees < 3.0 ? Visit::Outcome::kDone : Visit::Outcome::kDrifted);
  }
  EXPECT_EQ(first.drift(), 0.0);
  // It comes back elsewhere.
  Visit back(model, protocol, &first.rest_before());
  bool went = false;
  RobotMeasurement at = standing(*model, protocol.rest);
  for (double t = 0.0; t < 60.0 && back.outcome() == Visit::Outcome::kRunning; t += kTick) {
    const Visit::Order order = back.step(at, t);
    went = went || order.aim == Visit::Aim::kTarget;
    at = standing(*model, order.aim == Visit::Aim::kTarget ? protocol.targets[2]
                          : went                           ? moved
                                                           : protocol.rest);
  }
  EXPECT_EQ(back.outcome(), Visit::Outcome::kDrifted);
  EXPECT_NE(back.reason().value().find("4.00 degrees at joint shoulder"), std::string::npos)
      << back.reason().value();
}

TEST_F(VisitTest, TheSimulatedRobotSettlesNearItsTargets) {
  load("tier1_equilibria");
  Simulation sim(model);
  for (const std::size_t i : {3u, 10u}) {
    Visit visit(model, protocol, nullptr);
    const Protocol::Target& target = protocol.targets[i];
    RobotMeasurement measured = standing(*model, protocol.rest);
    for (double t = 0.0; t < 90.0 && visit.outcome() == Visit::Outcome::kRunning; t += 0.005) {
      measured.q = sim.configuration();
      for (int m = 0; m < 8; ++m) measured.muscles[m] = sim.muscle(m).measured();
      const auto& reference = visit.step(measured, t).aim == Visit::Aim::kRest
                                  ? protocol.rest.reference
                                  : target.reference;
      for (int m = 0; m < 8; ++m) sim.command(m, ecu::Mode::kPosition, reference[m]);
      sim.step(5);
    }
    ASSERT_EQ(visit.outcome(), Visit::Outcome::kDone) << visit.reason().value_or("");
    // Eyelet friction keeps it from getting there.
    EXPECT_LT(joint_distance(model->skeleton->joints[0], visit.target().q, target.q), 0.35);
    EXPECT_GT(joint_distance(model->skeleton->joints[0], visit.target().q, protocol.rest.q), 0.3);
    double sum = 0.0;  // a muscle or two may be slack: friction in the eyelets
    for (int m = 0; m < 8; ++m) sum += visit.target().force[m];
    EXPECT_GT(sum, 8.0);
  }
}

}  // namespace
}  // namespace anthrob
