// Least-effort tensions: against the statics' independent solver, and by the conditions of
// optimality.
#include "anthrob_control/tension_split.h"

#include <gtest/gtest.h>

#include <random>

#include "anthrob_sim/statics/equilibrium.h"

namespace anthrob {
namespace {

struct Problem {
  Eigen::MatrixXd A;
  Eigen::VectorXd tau, lowest, highest;
};

/// @param reach largest tension [N] with which the torque was made; above the bound it may be out
/// of reach
Problem random_problem(std::mt19937& random, int torques, int muscles, double reach) {
  std::uniform_real_distribution<double> arm(-0.06, 0.06), tension(1.0, reach);
  Problem p{Eigen::MatrixXd(torques, muscles),
            {},
            Eigen::VectorXd::Constant(muscles, 1.0),
            Eigen::VectorXd::Constant(muscles, 80.0)};
  Eigen::VectorXd f(muscles);
  for (Eigen::Index i = 0; i < p.A.size(); ++i) p.A.data()[i] = arm(random);
  for (int i = 0; i < muscles; ++i) f[i] = tension(random);
  p.tau = p.A * f;
  return p;
}

TEST(TensionSplit, AgreesWithTheIndependentSolver) {
  std::mt19937 random(1);
  for (int run = 0; run < 300; ++run) {
    const int torques = 1 + run % 4, muscles = torques + 1 + run % 8;
    const Problem p = random_problem(random, torques, muscles, 80.0);
    TensionSplit split(torques, p.lowest, p.highest);
    const auto& result = split.solve(p.A, p.tau);
    const LeastEffort reference = least_effort(p.A, p.tau, p.lowest, p.highest);
    ASSERT_TRUE(result.converged) << run;
    EXPECT_LT(result.shortfall.norm(), 1e-4) << run;
    EXPECT_LT((result.tension - reference.tension).cwiseAbs().maxCoeff(), 0.02) << run;
    // The softness lets a badly conditioned torque off lightly, never more than that.
    EXPECT_NEAR(result.tension.norm(), reference.tension.norm(), 1e-4 * reference.tension.norm())
        << run;
  }
}

TEST(TensionSplit, AnswersOutOfReachAreTheNearest) {
  // Of a bounded least-squares problem: the gradient A^T shortfall pushes every muscle against its
  // bound.
  std::mt19937 random(2);
  int out_of_reach = 0;
  for (int run = 0; run < 300; ++run) {
    const Problem p = random_problem(random, 4, 8, 400.0);
    TensionSplit split(4, p.lowest, p.highest);
    const auto& result = split.solve(p.A, p.tau);
    ASSERT_TRUE(result.converged) << run;
    EXPECT_LT((p.A * result.tension + result.shortfall - p.tau).norm(), 1e-9);
    if (result.shortfall.norm() < 1e-4) continue;
    ++out_of_reach;
    const Eigen::VectorXd push = p.A.transpose() * result.shortfall;
    for (int m = 0; m < 8; ++m) {
      if (std::abs(push[m]) < 1e-5) continue;
      EXPECT_EQ(result.tension[m], push[m] > 0.0 ? p.highest[m] : p.lowest[m]) << run;
    }
  }
  EXPECT_GT(out_of_reach, 100);
}

TEST(TensionSplit, AWarmStartTakesFewStepsAndGivesTheSame) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 1.0);
  Problem p = random_problem(random, 4, 11, 60.0);
  TensionSplit warm(4, p.lowest, p.highest);
  warm.solve(p.A, p.tau);
  int most = 0;
  for (int step = 0; step < 500; ++step) {
    for (Eigen::Index i = 0; i < p.A.size(); ++i) p.A.data()[i] += 1e-4 * noise(random);
    for (Eigen::Index i = 0; i < 4; ++i) p.tau[i] += 0.01 * noise(random);
    const auto& result = warm.solve(p.A, p.tau);
    ASSERT_TRUE(result.converged);
    most = std::max(most, result.iterations);
    TensionSplit cold(4, p.lowest, p.highest);
    EXPECT_LT((cold.solve(p.A, p.tau).tension - result.tension).cwiseAbs().maxCoeff(), 1e-4);
  }
  EXPECT_LE(most, 12);
  RecordProperty("most_iterations", most);
}

TEST(TensionSplit, RefusesNonsense) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(2), two = 2.0 * one;
  EXPECT_THROW(TensionSplit(1, two, one), std::invalid_argument);
  EXPECT_THROW(TensionSplit(1, one, Eigen::VectorXd::Ones(3)), std::invalid_argument);
  TensionSplit split(1, one, two);
  EXPECT_THROW(split.solve(Eigen::MatrixXd::Ones(1, 3), Eigen::VectorXd::Ones(1)),
               std::invalid_argument);
  EXPECT_THROW(split.solve(Eigen::MatrixXd::Constant(1, 2, NAN), Eigen::VectorXd::Ones(1)),
               std::invalid_argument);
}

}  // namespace
}  // namespace anthrob
