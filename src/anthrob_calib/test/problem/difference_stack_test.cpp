// Differences of all runs as rows of least squares, with their noise.
#include "problem/difference_stack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "optimiser/evaluator.h"
#include "rig_problem.h"

namespace anthrob {
namespace calibration {
namespace {

TEST(DifferenceStack, ListsWhatTheFitMinimises) {
  Weights uneven;
  uneven.before = 2.0, uneven.path = 0.5, uneven.after = 0.0;
  for (const Weights& weights : {Weights{}, uneven}) {
    for (const char* kind : {"equilibrium", "trajectory"}) {
      const Problem problem = problem_of(runs_of(rig(), kind, 1.0), kParameters, weights);
      Point point = problem.space().initial();
      point[0] += 0.001;
      DifferenceStack stack(problem, [] {});
      const std::vector<double> list = stack.describe(point);
      EXPECT_EQ(list, problem.residuals(point)) << kind;
      EXPECT_EQ(stack.residuals({point}).front(), list) << kind;
      EXPECT_NEAR(std::inner_product(list.begin(), list.end(), list.begin(), 0.0),
                  problem.fitness(point), 1e-12);
      ASSERT_EQ(stack.rows.size(), list.size());
      for (const DifferenceStack::Row& row : stack.rows) {
        EXPECT_GE(row.instant, 0);
        EXPECT_LT(row.instant, stack.instants);
      }
    }
  }
}

/// Rows of the means, those before the runs and those after.
std::vector<DifferenceStack::Row> means_of(const Problem& problem, const Point& point) {
  DifferenceStack stack(problem, [] {});
  stack.describe(point);
  std::vector<DifferenceStack::Row> means;
  for (const DifferenceStack::Row& row : stack.rows) {
    if (!row.is_typical) means.push_back(row);
  }
  return means;
}

TEST(DifferenceStack, MeansHaveLessOfTheNoiseThatChanges) {
  const Problem problem =
      problem_of(runs_of(rig(), "trajectory", 1.0), kParameters, {}, as_recorded());
  const auto means = means_of(problem, problem.space().initial());
  ASSERT_EQ(means.size(), 5u * 2u * 3u);  // before and after: one joint, two muscles
  for (const DifferenceStack::Row& row : means) {
    // Of 21 measurements, without a memory.
    EXPECT_GT(row.deviation, 0.9 / std::sqrt(21.0));
    EXPECT_LT(row.deviation, 0.5);
    EXPECT_EQ(row.repetition, 1.0);
    EXPECT_FALSE(row.related.empty());
    for (const auto& [other, covariance] : row.related) {
      EXPECT_GT(covariance, 0.0);
      EXPECT_LE(covariance, 1.0);
    }
  }
}

TEST(DifferenceStack, NoiseDoesNotHideHowLongErrorsLast) {
  const Problem problem =
      problem_of(runs_of(rig(), "trajectory", 1.0), kParameters, {}, as_recorded());
  const auto repetition_at = [&](double shift) {
    Point point = problem.space().initial();
    point[0] += shift;
    DifferenceStack stack(problem, [] {});
    stack.describe(point);
    return stack.repetition;
  };
  for (const double noise_only : repetition_at(0.0)) EXPECT_LT(noise_only, 2.0);
  // An error of the angle about as large as its noise, which stays for all of the path.
  EXPECT_GT(repetition_at(0.0005)[DifferenceStack::kPosture], 20.0);
}

TEST(DifferenceStack, MeansKeepErrorsThatStay) {
  const Problem problem = problem_of(runs_of(rig(), "trajectory"));
  Point point = problem.space().initial();
  point[0] += 0.003;
  for (const DifferenceStack::Row& row : means_of(problem, point)) {
    EXPECT_GT(row.deviation, 0.7);
    EXPECT_GT(row.related.size(), 20u);
  }
}

TEST(DifferenceStack, MeansAreTheNoiseWhereNoPathIsFitted) {
  Weights ends;
  ends.path = 0.0;
  const Problem problem = problem_of(runs_of(rig(), "trajectory", 1.0), kParameters, ends);
  DifferenceStack stack(problem, [] {});
  stack.describe(problem.space().initial());
  int typical = 0;
  for (const DifferenceStack::Row& row : stack.rows) {
    EXPECT_EQ(row.is_typical, row.weight > 0.0);
    EXPECT_EQ(row.deviation, 1.0);
    typical += row.is_typical ? 1 : 0;
  }
  EXPECT_EQ(typical, 5 * 2 * 3);
}

TEST(ResidualNoise, IsNotMuchMoreThanWhatIsLeft) {
  const Problem problem = problem_of(runs_of(rig(), "equilibrium", 1.0));
  DifferenceStack stack(problem, [] {});
  const std::vector<double> left = stack.describe(problem.space().initial());
  const auto rows = static_cast<Eigen::Index>(left.size());
  double square = 0.0, count = 0.0;
  for (std::size_t k = 0; k < left.size(); ++k) {
    if (stack.rows[k].kind != DifferenceStack::kForce) continue;
    square += std::pow(left[k] / stack.rows[k].weight, 2);
    count += 1.0;
  }
  const double rms = std::sqrt(square / count);
  // Half of the rows go into the parameters: the rest tells of the noise.
  const ResidualNoise known(stack, left, Eigen::VectorXd::Constant(rows, 0.5));
  EXPECT_NEAR(known.force, rms * std::sqrt(2.0), 1e-9);
  EXPECT_FALSE(known.absorbed[DifferenceStack::kForce]);
  // Each row counts for fifty: the parameters could have followed more than there is.
  for (DifferenceStack::Row& row : stack.rows) row.repetition = 50.0;
  const ResidualNoise doubtful(stack, left, Eigen::VectorXd::Constant(rows, 0.5));
  EXPECT_NEAR(doubtful.force, rms * std::sqrt(10.0), 1e-9);
  EXPECT_TRUE(doubtful.absorbed[DifferenceStack::kForce]);
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
