// What a search minimises.
#include "problem/problem.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numeric>

#include "anthrob_core/errors.h"
#include "calibration/problem_evaluator.h"
#include "optimiser/optimiser.h"
#include "rig_problem.h"

namespace anthrob {
namespace calibration {
namespace {

TEST(Problem, IsZeroAtTheTruthAndResidualsAddUp) {
  for (const char* kind : {"equilibrium", "trajectory"}) {
    const Problem problem = problem_of(runs_of(rig(), kind));
    std::vector<double> values = problem.space().initial();
    // What is left comes from means over time against single instants.
    EXPECT_LT(problem.fitness(values), 1e-6) << kind;
    values[0] += 0.002;
    const double fitness = problem.fitness(values);
    EXPECT_GT(fitness, 1e-4) << kind;
    const std::vector<double> r = problem.residuals(values);
    EXPECT_NEAR(std::inner_product(r.begin(), r.end(), r.begin(), 0.0), fitness, 1e-12);
    EXPECT_EQ(problem.fitness(values), fitness);
  }
}

TEST(Problem, AnImpossibleRobotIsInvalid) {
  const Problem problem = problem_of(
      runs_of(rig(), "equilibrium"),
      "parameters: [{path: muscles.flexor.path.2.cylinder.radius, unit: m, low: 0.001, high: 0.2, "
      "step: 0.001}]");
  EXPECT_TRUE(std::isfinite(problem.fitness(problem.space().initial())));
  EXPECT_TRUE(std::isinf(problem.fitness({0.15})));  // the insertion would lie inside
  EXPECT_TRUE(problem.residuals({0.15}).empty());
}

TEST(Problem, EvaluatesWithoutTheFilesOfItsModel) {
  namespace fs = std::filesystem;
  const fs::path folder =
      fs::temp_directory_path() / ("anthrob_problem_test_" + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::copy(fs::path(kModelFile).parent_path(), folder, fs::copy_options::recursive);
  const auto copied = ConfigNode::load((folder / fs::path(kModelFile).filename()).string());
  const auto runs = runs_of(rig(), "equilibrium");
  const ParameterSpace space(ConfigNode::parse(kParameters, "c.yaml"), copied);
  const Problem problem(copied, space, runs, {}, {});
  fs::remove_all(folder);
  ASSERT_THROW(build_robot_model(copied), BadInput);

  std::vector<double> values = problem.space().initial();
  values[0] += 0.002;
  EXPECT_EQ(problem.fitness(values), problem_of(runs).fitness(values));
}

TEST(Calibration, LeastSquaresFindsForgottenParameters) {
  const std::vector<double> truth = {0.3635, 0.3668, 0.0068, 0.0066};
  const Problem blank = problem_of({});
  Problem problem = problem_of(runs_of(blank.build(truth), "equilibrium"));
  ProblemEvaluator evaluator(problem);
  OptimiserSettings settings;
  settings.method = "least_squares";
  settings.generations = 20;
  const SearchResult result =
      make_optimiser(settings)->minimise(search_variables(problem.space()), evaluator);
  EXPECT_LT(result.fitness, 1e-6);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(result.best[i], truth[i], i < 2 ? 2e-4 : 4e-5) << i;
  }
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
