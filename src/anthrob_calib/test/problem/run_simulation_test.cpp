// Recorded runs simulated again: in which order, from where, for how long.
#include "problem/run_simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>

#include "optimiser/journal.h"
#include "rig_problem.h"

namespace anthrob {
namespace calibration {
namespace {

TEST(Chains, OneRunLeadsToTheOther) {
  MeasuredRun out, back, alone;
  out.start = {0.0}, out.commands = {{0.0, {1.0}}};
  back.start = {1.0}, back.commands = {{0.0, {0.0}}};
  alone.start = {7.0}, alone.commands = {{0.0, {0.0}}};
  const auto chains = chains_of({back, out, out, alone});
  ASSERT_EQ(chains.size(), 3u);
  EXPECT_EQ(chains[0].runs, (std::vector<int>{1, 0}));
  EXPECT_EQ(chains[1].runs, (std::vector<int>{2}));
  EXPECT_EQ(chains[2].runs, (std::vector<int>{3}));
  EXPECT_TRUE(chains[0].from_home);
  EXPECT_FALSE(chains[2].from_home);
}

TEST(Chains, APairBeginsWithTheRunThatComesFirst) {
  MeasuredRun out, back;
  out.start = {1.0}, out.commands = {{0.0, {0.0}}};
  back.start = {0.0}, back.commands = {{0.0, {1.0}}};
  const auto chains = chains_of({out, back});
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].runs, (std::vector<int>{0, 1}));
  EXPECT_TRUE(chains[0].from_home);
}

TEST(Chains, DoNotDependOnTheOrderOfTheRuns) {
  const auto run = [](double from, double to) {
    MeasuredRun result;
    result.start = {from}, result.commands = {{0.0, {to}}};
    return result;
  };
  using Ways = std::vector<std::pair<double, double>>;
  std::vector<MeasuredRun> runs = {run(0, 1), run(1, 2), run(2, 3), run(0, 4),
                                   run(4, 0), run(0, 5), run(7, 8), run(8, 9)};
  const std::vector<Ways> expected = {
      {{0, 1}, {1, 2}, {2, 3}}, {{0, 4}, {4, 0}}, {{0, 5}}, {{7, 8}, {8, 9}}};
  std::mt19937 random(1);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Ways> found;
    for (const Chain& chain : chains_of(runs)) {
      found.emplace_back();
      for (const int r : chain.runs) {
        found.back().emplace_back(runs[r].start[0], runs[r].commands.back().reference[0]);
      }
      EXPECT_EQ(chain.from_home, found.back().front().first == 0.0);
    }
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected) << trial;
    std::shuffle(runs.begin(), runs.end(), random);
  }
}

TEST(Chains, OnesThatGoInCirclesBeginSomewhere) {
  MeasuredRun home, out, back;
  home.start = {0.0}, home.commands = {{0.0, {5.0}}};
  out.start = {1.0}, out.commands = {{0.0, {2.0}}};
  back.start = {2.0}, back.commands = {{0.0, {1.0}}};
  const auto chains = chains_of({home, out, back});
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_EQ(chains[1].runs, (std::vector<int>{1, 2}));
  EXPECT_FALSE(chains[1].from_home);
}

TEST(SimulateRuns, StopWhereTheyAreAsked) {
  const std::vector<MeasuredRun> runs = runs_of(rig(), "trajectory");
  SimulationOptions options;
  options.settle = options.motion = 5.0;
  std::atomic<int> asked{0};
  simulate_runs(rig(), runs, options, [&] {
    ++asked;
    return false;
  });
  const int all = asked;
  EXPECT_GT(all, static_cast<int>(runs.size()));  // at rest and in each run
  for (const int last : {1, all}) {
    asked = 0;
    EXPECT_THROW(simulate_runs(rig(), runs, options, [&] { return ++asked >= last; }), Interrupted);
    EXPECT_LE(asked, all);
  }
}

TEST(SimulateRuns, EachRestsAsLongAsItsRobotDid) {
  std::vector<MeasuredRun> runs;
  for (const double settle : {0.2, 2.0, 0.7}) {  // rings go on relaxing
    RecordingPlan p = plan(3.0, 0.0, "equilibrium");
    p.settle = settle;
    runs.push_back(read_run(record_simulation(rig(), p), rig()));
  }
  SimulationOptions options;
  options.settle = options.motion = 5.0;
  for (const RunDifferences& run : simulate_runs(rig(), runs, options)) {
    EXPECT_LT(run.shown().posture.norm(), 1e-7);
    EXPECT_LT(run.shown().force.norm(), 1e-5);
  }
}

TEST(SimulateRuns, AreComparedAsTheModelsSensorsMeasure) {
  const auto sensed = std::make_shared<RobotModel>(*rig());
  for (SensorModel* sensor : {&sensed->sensors.force, &sensed->sensors.joint_position}) {
    sensor->delay = 0.02;
    sensor->average = 10;
  }
  const std::vector<MeasuredRun> runs = runs_of(sensed, "trajectory");
  const auto differences = [&](const std::shared_ptr<const RobotModel>& model) {
    double force = 0.0, posture = 0.0;
    for (const RunDifferences& run : simulate_runs(model, runs, as_recorded())) {
      force = std::max(force, run.path.force.cwiseAbs().maxCoeff());
      posture = std::max(posture, run.path.posture.cwiseAbs().maxCoeff());
    }
    return std::make_pair(force, posture);
  };
  const auto same = differences(sensed), ideal = differences(rig());
  EXPECT_LT(same.first, 1e-6);
  EXPECT_LT(same.second, 1e-8);
  EXPECT_GT(ideal.first, 0.5);
  EXPECT_GT(ideal.second, 0.01);
  // Noise and counts are not predicted.
  const auto noisy = std::make_shared<RobotModel>(*sensed);
  noisy->sensors.force.noise = 1.0;
  noisy->sensors.joint_position.quantum = 0.1;
  EXPECT_EQ(differences(noisy), same);
}

TEST(SimulateRuns, ImposedPositionsAreWhatALateSensorReadThen) {
  const auto late = std::make_shared<RobotModel>(*rig());
  late->sensors.position.delay = 0.02;
  late->sensors.position.average = 11;
  SimulationOptions options = as_recorded();
  options.drive = Drive::kSampledPositions;
  double most = 0.0, way = 0.0;
  const std::vector<MeasuredRun> runs = runs_of(late, "trajectory");
  for (const RunDifferences& run : simulate_runs(late, runs, options)) {
    most = std::max(most, run.path.actuator.cwiseAbs().maxCoeff());
  }
  for (const RunDifferences& run : simulate_runs(rig(), runs, options)) {
    way = std::max(way, run.path.actuator.cwiseAbs().maxCoeff());
  }
  EXPECT_LT(way, 0.01);   // an ideal sensor shows what was imposed
  EXPECT_LT(most, 0.03);  // at up to 8 rad/s: 0.2 rad if the delay were forgotten
}

TEST(SimulateRuns, AReturnBeginsWhereImposedPositionsEnded) {
  RecordingPlan out = plan(4.0, -1.0, "trajectory"), other = plan(2.0, 0.0, "trajectory");
  RecordingPlan back = out;
  std::swap(back.from, back.to);
  std::vector<MeasuredRun> runs;
  for (const RecordingPlan& p : {out, other, back}) {
    runs.push_back(read_run(record_simulation(rig(), p), rig()));
  }
  SimulationOptions options;
  options.settle = options.motion = 5.0;
  options.drive = Drive::kSampledPositions;
  const auto differences = simulate_runs(rig(), runs, options);
  ASSERT_GT(differences[2].before.posture.size(), 0);
  EXPECT_LT(differences[2].before.posture.norm(), 0.02);
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
