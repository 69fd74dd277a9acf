// The report of a calibration, also of one that lacks a part.
#include "report/calibration_report.h"

#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>

#include "rendered_page.h"
#include "rig_problem.h"

namespace anthrob {
namespace calibration {
namespace {

std::string report_html(const CalibrationOutcome& outcome) {
  return rendered_page("calibration", report_files(outcome), "result.json");
}

TEST(CalibrationReport, TellsRecordingsThatCannotBeSimulatedFromNone) {
  CalibrationOutcome outcome;
  EXPECT_NE(report_html(outcome).find("None were given (--validation)"), std::string::npos);
  outcome.held_out = true;
  outcome.doubt = "some results could not be computed: of numbers";
  const std::string page = report_html(outcome);
  EXPECT_EQ(page.find("None were given"), std::string::npos);
  EXPECT_NE(page.find("could not be simulated"), std::string::npos);
}

TEST(CalibrationReport, HasTheErrorsOfParametersWhereNoRecordingCouldBeReplayed) {
  CalibrationOutcome outcome;
  outcome.parameters.resize(1);
  outcome.parameters[0].path = "joints.elbow.friction.viscous";
  outcome.parameters[0].upper = 1.0;
  outcome.best = {0.5};
  outcome.identifiability.parameters = {{0.01, 0.3, 10.0, 0.0, 1.0, 0.04, true}};
  outcome.identifiability.singular_values = Eigen::VectorXd::Ones(1);
  outcome.identifiability.flattest = {1.0};
  const std::string page = report_html(outcome);
  EXPECT_NE(page.find("1 of 1 parameters are identifiable"), std::string::npos);
  EXPECT_NE(page.find("0.477719 ... 0.522281"), std::string::npos);  // Student's, 10 degrees
}

TEST(CalibrationReport, HasWhatOneOfTheModelsDoes) {
  CalibrationOutcome outcome;
  outcome.model = rig();
  outcome.held_out = true;
  outcome.validation.runs = runs_of(rig(), "trajectory");
  outcome.validation.after = simulate_runs(rig(), outcome.validation.runs, {});
  outcome.calibration.runs = outcome.validation.runs;
  outcome.calibration.before = outcome.validation.after;
  const std::string page = report_html(outcome);
  EXPECT_NE(page.find("On held-out recordings"), std::string::npos);
  EXPECT_NE(page.find("(before: not simulated)"), std::string::npos);
  EXPECT_NE(summary(outcome).find("force not simulated -> "), std::string::npos);
  EXPECT_NE(summary(outcome).find("-> not simulated N"), std::string::npos);
  const auto json = nlohmann::json::parse(result_json(outcome));
  for (const auto& [part, missing, present] : {std::array{"validation", "before", "after"},
                                               std::array{"calibration", "after", "before"}}) {
    EXPECT_TRUE(json[part]["mean"][missing].is_null()) << part;
    EXPECT_TRUE(json[part]["mean"][present]["force_N"].is_number()) << part;
    EXPECT_TRUE(json[part]["runs"][0][missing].is_null()) << part;
    EXPECT_TRUE(json[part]["runs"][0][present].is_object()) << part;
  }
}

TEST(CalibrationReport, HeadlineIsTheVerdict) {
  CalibrationOutcome outcome;
  outcome.parameters.resize(7);
  for (std::size_t i = 0; i < outcome.parameters.size(); ++i) {
    outcome.parameters[i].path = "p" + std::to_string(i);
    outcome.parameters[i].upper = 1.0;
  }
  outcome.best.assign(7, 0.5);
  outcome.fitness_before = 2.0;
  outcome.fitness = 0.5;
  EXPECT_EQ(headline(outcome, true), "usable: fitness 2 -> 0.5");
  EXPECT_EQ(headline(outcome, false), "not searched to the end: fitness 2 -> 0.5");
  outcome.best[1] = 1.0;
  outcome.sensitivity = {1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0};
  EXPECT_EQ(
      headline(outcome, true),
      "look at these parameters: p1 (at the end of its range), p2 (not identifiable); fitness "
      "2 -> 0.5");
  outcome.identifiability.parameters.assign(7, {0.01, 0.3, 10.0, 0.0, 1.0, 0.5, false});
  EXPECT_NE(headline(outcome, true).find("p4 (not identifiable) and 2 more; fitness"),
            std::string::npos);
  outcome.fitness = 2.0;
  EXPECT_EQ(headline(outcome, true), "no better than the start: fitness 2 -> 2");
}

TEST(CalibrationReport, NamesWhatChangesNothingAlsoInBrief) {
  CalibrationOutcome outcome;
  outcome.parameters.resize(2);
  outcome.parameters[0].path = "joints.elbow.friction.viscous";
  outcome.parameters[1].path = "joints.elbow.friction.coulomb";
  outcome.best = {0.5, 0.5};
  for (ModelParameter& p : outcome.parameters) p.upper = 1.0;
  EXPECT_TRUE(insensitive_parameters(outcome).empty());  // by a search without derivatives
  EXPECT_EQ(report_html(outcome).find("<b>no</b>"), std::string::npos);
  outcome.sensitivity = {3.0, 1e-9};
  EXPECT_EQ(insensitive_parameters(outcome), std::vector<std::string>{"elbow.friction.coulomb"});
  const std::string page = report_html(outcome);
  const std::size_t name = page.find("elbow.friction.coulomb"), no = page.find("<b>no</b>");
  ASSERT_NE(name, std::string::npos);
  ASSERT_NE(no, std::string::npos);
  EXPECT_GT(no, name);
}

TEST(CalibrationReport, GivesNoIntervalAtTheEndOfARange) {
  CalibrationOutcome outcome;
  outcome.parameters.resize(2);
  for (ModelParameter& p : outcome.parameters) p.upper = 1.0;
  outcome.best = {0.5, 1.0};
  outcome.identifiability.parameters = {{0.01, 0.3, 10.0, 0.0, 1.0, 0.04, true},
                                        {0.01, 0.3, 10.0, 0.0, 1.0, 0.04, true}};
  outcome.identifiability.singular_values = Eigen::VectorXd::Ones(2);
  outcome.identifiability.flattest = {1.0, 0.0};
  EXPECT_FALSE(is_at_bound(outcome, 0));
  EXPECT_TRUE(is_at_bound(outcome, 1));
  const auto list = nlohmann::json::parse(result_json(outcome))["parameters"];
  EXPECT_TRUE(list[0]["ci95"][0].is_number());
  EXPECT_EQ(list[0].count("at_bound"), 0u);
  EXPECT_TRUE(list[1]["ci95"][0].is_null());
  EXPECT_EQ(list[1]["at_bound"], true);
}

TEST(CalibrationReport, SaysThatTheSearchLookedTooEarly) {
  CalibrationOutcome outcome;
  outcome.fitness = 4e-6;
  outcome.simulation.motion = 2.0;
  outcome.moves_on = 1e-7;
  EXPECT_EQ(too_early(outcome), std::nullopt);
  outcome.moves_on = 2e-6;
  EXPECT_NE(too_early(outcome).value().find("after 2 s of motion"), std::string::npos);
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
