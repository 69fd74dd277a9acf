// Least squares of residuals that are made, so that slopes and ends are known.
#include "anthrob_calib/discovery/model_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "anthrob_calib/discovery/naming.h"
#include "anthrob_sim/effects/catalogue.h"

namespace anthrob {
namespace discovery {
namespace {

using Curve = std::function<double(double)>;

constexpr double kStep = 0.001, kCoarse = 0.002;  // [s]

/// Differences that depend on a number of the model alone, the damping of its elbow, and maybe
/// otherwise with the coarse step.
class Made final : public Experiment {
 public:
  Made(Curve difference, Curve coarse)
      : difference_(std::move(difference)), coarse_(std::move(coarse)) {
    channels_ = {{"elbow", "position", "rad", 0, 0, 1, 0.0}};
    present_.assign(1, 1);
  }
  void compare(const std::shared_ptr<const RobotModel>& model, Starts&, float* out) const override {
    const Curve& difference = model->step == kCoarse ? coarse_ : difference_;
    out[0] = static_cast<float>(difference(damping_of(*model)));
  }

 private:
  static double damping_of(const RobotModel& model) {
    const auto elbow = static_cast<std::size_t>(model.skeleton->find_joint("elbow"));
    return model.skeleton->joints[elbow].friction.viscous;
  }

  Curve difference_, coarse_;
};

/// That number free between 0 and 100, 1 at a time, expected anywhere.
struct Problem {
  explicit Problem(const Curve& difference) : Problem(difference, difference) {}
  Problem(Curve difference, Curve coarse)
      : evaluator(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml",
                  {{"joints.elbow.friction.viscous", "Nms/rad", 50.0, 0.0, 100.0, 1.0}}, kStep, 1),
        fit(evaluator, {std::make_shared<Made>(std::move(difference), std::move(coarse))},
            Eigen::VectorXf::Ones(1), kCoarse) {}

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
  problem.fit.polish(fitted, 0);
  EXPECT_NEAR(fitted.sensitivity(0, 0), 0.2, 1e-4);
  problem.fit.polish(fitted, 0, ModelFit::Slopes::kOneSide);
  EXPECT_NEAR(fitted.sensitivity(0, 0), 0.205, 1e-4);
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
  // Teeth as long as a step: to one side they hide the slope.
  const Problem problem(
      [](double x) { return 0.2 * (x - 20.0) + 2.0 * (x - std::floor(x)) - 1.0; });
  Fitted fitted = problem.start(80.0);
  EXPECT_GT(fitted.sensitivity(0, 0), 2.0);
  problem.fit.polish(fitted, 1);
  EXPECT_NEAR(fitted.sensitivity(0, 0), 0.2, 0.05);
  EXPECT_NEAR(fitted.variant.nuisances[0], 20.0, 6.0);
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

TEST(BestOfKinds, OneEffectDoesNotCrowdOutTheOthers) {
  const Effect *const a = all_effects()[0], *const b = all_effects()[1];
  const std::vector<const Effect*> kinds = {a, a, a, a, b, a, b};
  using Places = std::vector<std::size_t>;
  EXPECT_EQ(best_of_kinds(kinds, 2, 4), (Places{0, 1, 4, 6}));
  EXPECT_EQ(best_of_kinds(kinds, 2, 6), (Places{0, 1, 4, 6, 2, 3}));
  EXPECT_EQ(best_of_kinds(kinds, 7, 3), (Places{0, 1, 2}));
  EXPECT_EQ(best_of_kinds({}, 2, 4), Places{});
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
