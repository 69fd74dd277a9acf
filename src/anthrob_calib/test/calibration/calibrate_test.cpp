// What follows the search of a calibration.
#include "calibration/calibrate.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "anthrob_sim/core/errors.h"
#include "calibration/problem_evaluator.h"
#include "optimiser/journal.h"
#include "two_muscle_rig.h"

namespace anthrob {
namespace calibration {
namespace {

/// What follows a search, with a stop that fails as a simulation does.
class Conclusion : public testing::Test {
 protected:
  Conclusion()
      : folder_(std::filesystem::temp_directory_path() /
                ("conclusion_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    LoadOptions truth;
    truth.overrides = {{"muscles.flexor.rest_tendon_length", kTruth}};
    record_simulation(load_robot_model(kModelFile, truth), plan(2.0, 0.0, "trajectory"))
        .save((folder_ / "data/T1").string());
    std::ofstream((folder_ / "c.yaml").string())
        << "model: " << kModelFile << "\nrecordings: trajectories\n"
        << "simulate: {settle: 0.5, motion: 0.5}\n"
        << "optimiser: {method: evolution_strategy, parents: 2, offspring: 8, generations: 5, "
           "seed: 3}\n"
        << "parameters:\n  - {path: muscles.flexor.rest_tendon_length, unit: m, range: 0.006, "
           "step: 0.001}\n";
  }
  ~Conclusion() override { std::filesystem::remove_all(folder_); }

  /// @param found whether the search has found the truth
  CalibrationOutcome conclude_after(bool found, const Stop& stop) const {
    const auto input =
        CalibrationInput::read(CalibrationConfig::load((folder_ / "c.yaml").string()),
                               {"data", {Dataset::load((folder_ / "data/T1").string())}}, {}, {});
    const Problem problem = input.problem();
    ProblemEvaluator evaluator(problem);
    Journal journal(evaluator, Journal::Options());
    if (found) journal.fitness(std::vector<Point>{Point{kTruth}});
    return conclude(input, problem, journal, "", false, stop);
  }

  static constexpr double kTruth = 0.3625;
  std::filesystem::path folder_;
};

TEST_F(Conclusion, OneModelThatCannotBeSimulatedTakesNothingFromTheOther) {
  int asked = 0;
  const CalibrationOutcome outcome = conclude_after(true, [&] {
    if (++asked == 1) throw NumericalFailure(1.0, "body x", "not finite");
    return false;
  });
  EXPECT_LT(outcome.fitness, outcome.fitness_before);
  EXPECT_TRUE(outcome.calibration.before.empty());
  ASSERT_EQ(outcome.calibration.runs.size(), 1u);
  ASSERT_EQ(outcome.calibration.after.size(), 1u);
  EXPECT_LT(outcome.calibration.after[0].path.posture.norm(), 0.1);
  EXPECT_NE(outcome.doubt.find("body x"), std::string::npos) << outcome.doubt;
}

TEST_F(Conclusion, WhatFailsTwiceIsSaidOnce) {
  const CalibrationOutcome outcome =
      conclude_after(true, []() -> bool { throw NumericalFailure(1.0, "body x", "not finite"); });
  EXPECT_TRUE(outcome.calibration.runs.empty());
  const std::size_t first = outcome.doubt.find("body x");
  ASSERT_NE(first, std::string::npos) << outcome.doubt;
  EXPECT_EQ(outcome.doubt.find("body x", first + 1), std::string::npos) << outcome.doubt;
}

TEST_F(Conclusion, TheSameModelIsSimulatedOnce) {
  int once = 0, twice = 0;
  const CalibrationOutcome same = conclude_after(false, [&] { return ++once < 0; });
  const CalibrationOutcome other = conclude_after(true, [&] { return ++twice < 0; });
  EXPECT_GT(once, 0);
  EXPECT_EQ(twice, 2 * once);
  ASSERT_EQ(same.calibration.after.size(), 1u);
  EXPECT_EQ(same.calibration.after[0].path.posture, same.calibration.before[0].path.posture);
  EXPECT_FALSE(other.interrupted);
}

TEST_F(Conclusion, KeepsWhatItHasWhenItIsInterrupted) {
  int asked = 0, all = 0;
  conclude_after(true, [&] { return ++all < 0; });
  const CalibrationOutcome outcome = conclude_after(true, [&] { return ++asked >= all; });
  EXPECT_TRUE(outcome.interrupted);
  EXPECT_EQ(outcome.calibration.before.size(), 1u);
  EXPECT_TRUE(outcome.calibration.after.empty());
  EXPECT_NE(outcome.doubt.find("interrupted before the errors on all recordings"),
            std::string::npos)
      << outcome.doubt;
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
