// Least squares of residuals that are made, so that slopes and ends are known.
#include "fit/model_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

#include "dry_elbow.h"
#include "made_experiment.h"

namespace anthrob {
namespace discovery {
namespace {

using Curve = std::function<double(double)>;

MadeExperiment::Law of_elbow(Curve curve) {
  return [curve = std::move(curve)](double elbow, double, double) { return curve(elbow); };
}

/// The elbow's damping free between 0 and 100, 1 at a time, expected anywhere.
struct Problem {
  explicit Problem(const Curve& difference) : Problem(difference, difference) {}
  Problem(const Curve& difference, const Curve& coarse)
      : evaluator(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml",
                  {{"joints.elbow.friction.viscous", "Nms/rad", 50.0, 0.0, 100.0, 1.0}},
                  MadeExperiment::kStep, 1),
        fit(evaluator, {std::make_shared<MadeExperiment>(of_elbow(difference), of_elbow(coarse))},
            Eigen::VectorXf::Ones(1), {}, MadeExperiment::kCoarse) {}

  Fitted start(double at) const {
    auto unknowns = nuisance_unknowns(evaluator);
    unknowns[0].spread = 0.0;
    return fit.start(Variant{{at}}, unknowns);
  }

  Evaluator evaluator;
  ModelFit fit;
};

TEST(ModelFit, StepsToBothSidesTellTheSlopeOfACurve) {
  const Problem problem([](double x) { return x * x / 100.0; });
  Fitted fitted = problem.start(10.0);
  EXPECT_NEAR(fitted.sensitivity(0, 0), 0.205, 1e-4);  // by half a step
  problem.fit.polish(fitted, 0, ModelFit::Slopes::kOneSide);
  EXPECT_NEAR(fitted.sensitivity(0, 0), 0.205, 1e-4);
  problem.fit.polish(fitted, 0);
  EXPECT_NEAR(fitted.sensitivity(0, 0), 0.2, 1e-4);
}

TEST(ModelFit, AtABoundOneSideHasToDo) {
  const Problem problem([](double x) { return x; });
  for (const double bound : {0.0, 100.0}) {
    Fitted fitted = problem.start(bound);
    EXPECT_NEAR(fitted.sensitivity(0, 0), 1.0, 1e-4) << bound;
    problem.fit.polish(fitted, 0);
    EXPECT_NEAR(fitted.sensitivity(0, 0), 1.0, 1e-4) << bound;
  }
}

TEST(ModelFit, SeesThroughRuggedGround) {
  // Teeth as long as steps to both sides: to one side they hide the slope.
  const Problem problem([](double x) {
    const double teeth = x / 0.7;
    return 0.2 * (x - 20.0) + 2.0 * (teeth - std::floor(teeth)) - 1.0;
  });
  Fitted fitted = problem.start(77.07);
  EXPECT_GT(fitted.sensitivity(0, 0), 2.0);
  problem.fit.polish(fitted, 1);
  EXPECT_NEAR(fitted.sensitivity(0, 0), 0.2, 0.05);
  EXPECT_NEAR(fitted.variant.nuisances[0], 20.0, 6.0);
}

TEST(ModelFit, OneSideIsEnoughWhereTheBendIsSmooth) {
  const Problem problem([](double x) { return x * x / 100.0; });
  Fitted fitted = problem.start(10.0);
  const auto simulated = [&](ModelFit::Slopes slopes) {
    const auto before = problem.evaluator.simulated();
    problem.fit.polish(fitted, 0, slopes);
    return problem.evaluator.simulated() - before;
  };
  const auto both_sides = simulated(ModelFit::Slopes::kBothSides);
  problem.fit.move(fitted, Variant{{20.0}});
  EXPECT_EQ(simulated(ModelFit::Slopes::kBothSides), both_sides - 1);
  EXPECT_NEAR(fitted.sensitivity(0, 0), 0.4, 1e-4);
  fitted.unknowns[0].upper = 20.0;  // the other side does it as well
  EXPECT_EQ(simulated(ModelFit::Slopes::kBothSides), both_sides - 1);
  EXPECT_NEAR(fitted.sensitivity(0, 0), 0.4, 1e-4);
  EXPECT_EQ(simulated(ModelFit::Slopes::kExactToBothSides),
            simulated(ModelFit::Slopes::kExact) + 1);
}

TEST(ModelFit, RuggedGroundIsAskedToBothSidesEveryTime) {
  const Problem problem([](double x) { return 0.2 * x + 3.0 * std::abs(x - std::round(x)); });
  Fitted fitted = problem.start(10.0);
  const auto begin = problem.evaluator.simulated();
  problem.fit.polish(fitted, 0);
  const auto first = problem.evaluator.simulated();
  problem.fit.polish(fitted, 0);
  EXPECT_EQ(problem.evaluator.simulated() - first, first - begin);
}

TEST(ModelFit, EndsWhereTheIterationsLeftWouldNotReachARival) {
  const Problem problem([](double x) { return 5.0 + 5.0 / (1.0 + x); });
  const auto ends_at = [&](double rival) {
    Fitted fitted = problem.start(0.0);
    problem.fit.improve(fitted, 8, 0.0, rival);
    return fitted.cost;
  };
  const double end = ends_at(HUGE_VAL);
  EXPECT_EQ(ends_at(end), end);
  EXPECT_GT(ends_at(0.0), 1.005 * end);
}

TEST(ModelFit, AStepThatLeadsTooFarIsTakenShorter) {
  // Gauss-Newton from 2 beside the root diverges, also at half the step.
  const Problem problem([](double x) { return std::atan(2.0 * (x - 50.0)); });
  Fitted fitted = problem.start(52.0);
  problem.fit.polish(fitted, 20);
  problem.fit.polish(fitted, 20);
  EXPECT_NEAR(fitted.variant.nuisances[0], 50.0, 0.05);
}

TEST(ModelFit, GoesOnWhereItLeadsDown) {
  // Each step ends where the slope is e times smaller: a valley that goes on.
  const Problem problem([](double x) { return std::exp(-x / 10.0); });
  Fitted one = problem.start(1.0);
  problem.fit.improve(one, 1, 0.0);
  Fitted longer = problem.start(1.0);
  problem.fit.polish(longer, 1);
  EXPECT_GT(longer.variant.nuisances[0] - 1.0, 1.9 * (one.variant.nuisances[0] - 1.0));
  EXPECT_LT(longer.cost, one.cost);
}

TEST(ModelFit, ExactSlopesLeadOnWhereThoseOfTheCoarseStepMislead) {
  const Problem problem([](double x) { return 0.1 * (x - 20.0); },
                        [](double x) { return -0.1 * (x - 20.0); });
  Fitted fitted = problem.start(80.0);
  const double cost = fitted.cost;
  problem.fit.polish(fitted, 4);
  EXPECT_EQ(fitted.cost, cost);
  problem.fit.polish(fitted, 4, ModelFit::Slopes::kExact);
  EXPECT_NEAR(fitted.variant.nuisances[0], 20.0, 0.1);
}

/// From 80, where nothing is expected.
Fitted fitted_from_far(const Problem& problem, const ModelFit& fit) {
  auto unknowns = nuisance_unknowns(problem.evaluator);
  unknowns[0].spread = 0.0;
  Fitted fitted = fit.start(Variant{{80.0}}, unknowns);
  fit.improve(fitted, 20, 0.0);
  return fitted;
}

TEST(ModelFit, AStraightLineKeepsItsSlopeThoughStepsVanish) {
  const MadeExperiment::Law law = of_elbow([](double x) { return 0.7 * (x - 30.0); });
  const Problem problem([](double) { return 0.0; });
  constexpr std::size_t kBins = 100;
  const ModelFit fit(problem.evaluator, {std::make_shared<MadeExperiment>(law, law, kBins, 1)},
                     Eigen::VectorXf::Ones(kBins), {});
  const Fitted fitted = fitted_from_far(problem, fit);
  EXPECT_NEAR(fitted.variant.nuisances[0], 30.0, 0.5);
  EXPECT_NEAR(fitted.sensitivity.col(0).minCoeff(), 0.7, 1e-3);
  EXPECT_NEAR(fitted.sensitivity.col(0).maxCoeff(), 0.7, 1e-3);
}

/// Another one whose differences are rounded as those of a robot with muscles.
class RoundedExperiment final : public Experiment {
 public:
  RoundedExperiment(MadeExperiment exact, double rounding) : exact_(std::move(exact)) {
    channels_ = exact_.channels();
    channels_.front().rounding = rounding;
    present_ = exact_.present();
    bin_ = exact_.bin();
    duration_ = exact_.duration();
  }
  void compare(const std::shared_ptr<const RobotModel>& model, const Starts& starts,
               float* out) const override {
    exact_.compare(model, starts, out);
  }

 private:
  MadeExperiment exact_;
};

TEST(ModelFit, StepsThatRoundingHidesLeaveTheSensitivities) {
  const auto law = of_elbow([](double x) { return 0.7 * (x - 30.0); });
  const Problem problem([](double) { return 0.0; });
  constexpr std::size_t kBins = 100;
  constexpr double kRounding = 1.0 / 64.0;
  const ModelFit fit(
      problem.evaluator,
      {std::make_shared<RoundedExperiment>(MadeExperiment(law, law, kBins, 1), kRounding)},
      Eigen::VectorXf::Ones(kBins), {});
  const Fitted fitted = fitted_from_far(problem, fit);
  EXPECT_NEAR(fitted.variant.nuisances[0], 30.0, 0.5);
  // The smallest change that counts is as large as rounding.
  EXPECT_GE(fitted.sensitivity.col(0).minCoeff(), 0.0);
  EXPECT_LE(fitted.sensitivity.col(0).maxCoeff(), 1.4);
}

TEST(ModelFit, SensitivitiesToWhatHardlyMovedAreKeptFromRoundToRound) {
  const Problem problem([](double x) { return x * x / 100.0; });
  Fitted fitted = problem.start(10.0);
  std::optional<ModelFit::RefreshedJacobian> refreshed;
  const auto slope_at = [&](double x, ModelFit::Slopes slopes) {
    problem.fit.move(fitted, Variant{{x}});
    problem.fit.polish(fitted, 0, slopes, &refreshed);
    return fitted.sensitivity(0, 0);
  };
  EXPECT_NEAR(slope_at(10.0, ModelFit::Slopes::kBothSides), 0.2, 1e-4);
  const auto simulated = problem.evaluator.simulated();
  EXPECT_NEAR(slope_at(10.08, ModelFit::Slopes::kBothSides), 0.2, 1e-4);
  EXPECT_EQ(problem.evaluator.simulated(), simulated + 1);                   // the move alone
  EXPECT_NEAR(slope_at(10.16, ModelFit::Slopes::kBothSides), 0.2032, 1e-4);  // in two small steps
  EXPECT_NEAR(slope_at(10.24, ModelFit::Slopes::kExact), 0.2048, 1e-4);      // others are needed
}

TEST(ModelFit, SensitivitiesToEffectsAreSimulatedInEveryRound) {
  const DryElbow robot([](double dry) { return dry; });
  Fitted fitted = robot.with(2.0);
  std::optional<ModelFit::RefreshedJacobian> refreshed;
  for (int round = 0; round < 2; ++round) {
    fitted.sensitivity.setZero();
    robot.train.polish(fitted, 0, ModelFit::Slopes::kBothSides, &refreshed);
    EXPECT_GT(fitted.sensitivity(0, 0), 0.0f) << round;
  }
}

TEST(ModelFit, SensitivitiesToEffectsAreRenewed) {
  const DryElbow robot([](double dry) { return 3.0 * dry; });
  Fitted fitted = robot.with(2.0);
  fitted.sensitivity.setConstant(7.0f);
  robot.train.renew_effects(fitted);
  EXPECT_NEAR(fitted.sensitivity(0, 0), 3.0 * fitted.unknowns[0].scale, 1e-4);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
