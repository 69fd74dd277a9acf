#include "report/run_figures.h"

#include <gtest/gtest.h>

#include <string>

#include "report/search_figures.h"
#include "rig_problem.h"

namespace anthrob {
namespace calibration {
namespace {

bool has(const std::string& svg, const std::string& text) {
  return svg.find(text) != std::string::npos;
}

/// One that leaves rest, and one that returns to it; simulated by a softer and by the right model.
BeforeAfter there_and_back() {
  BeforeAfter both;
  both.runs = runs_of(rig(), "trajectory");
  MeasuredRun back = both.runs.front();
  both.runs.front().name = "E0_E1";
  back.name = "E1_E0";
  back.path.q = both.runs.front().path.q.colwise().reverse();
  both.runs.push_back(back);
  LoadOptions softer;
  softer.overrides["springs.rubber.modulus"] = 0.5e6;
  both.before = simulate_runs(load_robot_model(kModelFile, softer), both.runs, {});
  both.after = simulate_runs(rig(), both.runs, {});
  return both;
}

TEST(RunFigures, NameRunsAndTellThoseThatReturnToRest) {
  const BeforeAfter both = there_and_back();
  const std::string svg = errors_figure(both, *rig(), "Errors");
  for (const char* text : {">E0_E1<", ">E1_E0<", ">before<", ">after<", ">after, back to rest<",
                           ">mean after<", ">after: least, mean, largest<", "hinge error [deg]"}) {
    EXPECT_TRUE(has(svg, text)) << text;
  }
  BeforeAfter there = both;
  for (auto* list : {&there.before, &there.after}) list->pop_back();
  there.runs.pop_back();
  EXPECT_FALSE(has(errors_figure(there, *rig(), "Errors"), "back to rest"));
}

TEST(RunFigures, OfOneModelAlone) {
  BeforeAfter both = there_and_back();
  both.before.clear();
  EXPECT_FALSE(has(errors_figure(both, *rig(), "Errors"), ">before<"));
}

TEST(RunFigures, TheWorstTrajectoryIsTheOneThatIsNotReproduced) {
  const BeforeAfter both = there_and_back();
  // Nobody goes backwards in time.
  EXPECT_EQ(worst_trajectory(both, *rig()).value(), both.runs.size() - 1);
  EXPECT_EQ(worst_trajectory({both.runs, both.before, {}}, *rig()), std::nullopt);
}

TEST(SearchFigures, ShowEveryIndividual) {
  Generation first, second;
  first.evaluations = 3, first.best_ever = 0.1, first.fitness = {0.5, 0.1, 0.2};
  second.evaluations = 5, second.best_ever = 0.05, second.fitness = {0.05, HUGE_VAL};
  const std::string svg = fitness_figure({first, second});
  std::size_t points = 0;
  for (std::size_t at = 0; (at = svg.find("<circle", at)) != std::string::npos; ++at) ++points;
  EXPECT_EQ(points, 4u + 1u);  // without the one that could not be simulated; the legend
}

TEST(SearchFigures, NameParametersAndTheLimit) {
  std::vector<ModelParameter> parameters(2);
  parameters[0].path = "joints.elbow.friction.viscous";
  parameters[1].path = "joints.elbow.friction.static";
  Identifiability known;
  known.parameters = {{0.01, 0.3, 10.0, 0.0, 1.0, 0.04, true},
                      {0.3, 0.3, 10.0, 0.0, 1.0, 0.9, false}};
  const std::string svg = identifiability_figure(known, parameters);
  for (const ModelParameter& p : parameters) EXPECT_TRUE(has(svg, ">" + p.name() + "<"));
  for (const char* text : {">identifiable<", ">not<", ">limit<"}) EXPECT_TRUE(has(svg, text));
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
