#include "detectability/detectability.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "fit/likelihood_profile.h"

namespace anthrob {
namespace discovery {
namespace {

constexpr double kDose = 0.03;             // of a tilt [rad]
constexpr double kDamping = 0.15;          // of the model's shoulder [Nms/rad]
constexpr std::size_t kChannelBins = 500;  // of each channel
constexpr double kTimeStep = 0.001;        // [s]

/// A tilt of gravity by t doses and a shoulder's damping that is d tenths too high show as
/// 20 (t - d) in one channel, so that d follows t; as t - cubic d^3 and a constant in another; and
/// something that has nothing to do with either is large in a third one, where a coarse step errs.
class Tilted final : public Experiment {
 public:
  Tilted(double cubic, double constant, double large, std::size_t bins = kChannelBins)
      : shown_{0.0, constant, large}, cubic_(cubic), bins_(bins) {
    const char* places[] = {"shoulder", "elbow", "wrist"};
    for (std::size_t c = 0; c < kChannels; ++c) {
      channels_.push_back({places[c], "position", "rad", 0, c * bins, bins, 0.0});
    }
    present_.assign(kChannels * bins, 1);
    bin_ = 0.02;
    duration_ = bin_ * static_cast<double>(bins);
  }

  void compare(const std::shared_ptr<const RobotModel>& model, const Starts&,
               float* out) const override {
    const double t = std::asin(model->gravity.y() / model->gravity.norm()) / kDose;
    const auto shoulder = static_cast<std::size_t>(model->skeleton->find_joint("shoulder"));
    const double d = (model->skeleton->joints[shoulder].friction.viscous - kDamping) / 0.1;
    const double error = model->step > kTimeStep ? 5.0 : 0.0;
    const double change[] = {20.0 * (t - d), t - cubic_ * d * d * d, error};
    for (std::size_t b = 0; b < kChannels * bins_; ++b) {
      const std::size_t channel = b / bins_;
      out[b] = static_cast<float>(shown_[channel] + change[channel]);
    }
  }

  static constexpr std::size_t kChannels = 3;

 private:
  const double shown_[kChannels];
  const double cubic_;
  const std::size_t bins_;
};

struct TiltProblem {
  explicit TiltProblem(double cubic, double constant = 0.0, double large = 0.0, double coarse = 0.0)
      : half{{std::make_shared<Tilted>(cubic, constant, large, kChannelBins / 2)}, {}},
        evaluator(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml",
                  {{"joints.shoulder.friction.viscous", "Nms/rad", kDamping, -10.0, 10.0, 0.01}},
                  kTimeStep, 1),
        fit(evaluator, {std::make_shared<Tilted>(cubic, constant, large)},
            Eigen::VectorXf::Ones(Tilted::kChannels * kChannelBins), {}, coarse),
        hypotheses(evaluator, list_candidates(evaluator, {"gravity_tilt"}), fit, fit, fit, {}, {},
                   1),
        base(fit.start(Variant{{kDamping}}, nuisance_unknowns(evaluator))) {
    for (Eigen::Index b = 0; b < base.residual.size(); ++b) {
      if (b % static_cast<Eigen::Index>(kChannelBins) <
          static_cast<Eigen::Index>(kChannelBins / 2)) {
        half.rows.push_back(b);
      }
    }
  }

  double rise(double doses, double needed = 1.0) const {
    const LikelihoodProfile profile(fit, base);
    return profile.rise(candidates.at(0), 0, doses, needed).value_or(HUGE_VAL);
  }
  /// Of a tilt about x [rad], and in which list it is.
  std::pair<double, bool> smallest_visible() const {
    const Screening screening(fit, base, candidates, half, half, {});
    const Detectability found = detect(hypotheses, base, screening, screening.scores(base));
    const bool shows = found.visible.size() == 1;
    const auto& list = shows ? found.visible : found.not_visible;
    return {list.at(0).smallest_visible, shows};
  }

  Excerpt half;
  Evaluator evaluator;
  ModelFit fit;
  Hypotheses hypotheses;
  const std::vector<Candidate>& candidates = hypotheses.candidates;
  Fitted base;
};

TEST(LikelihoodProfile, IsWhatOrdinaryParametersCannotTakeUp) {
  for (const double cubic : {0.0, 0.5}) {
    for (const double large : {0.0, 300.0}) {
      // The constant is higher on one side by as much as lower on the other.
      const TiltProblem problem(cubic, 0.5, large);
      EXPECT_NEAR(problem.rise(1.0), 0.5 * kChannelBins * std::pow(1.0 - cubic, 2),
                  0.02 * 0.5 * kChannelBins)
          << large;
    }
  }
}

TEST(LikelihoodProfile, ComparesWithTheCoarseStepWhereThereIsOne) {
  const double usual = TiltProblem(0.5).rise(1.0);
  EXPECT_NEAR(TiltProblem(0.5, 0.0, 0.0, 2.0 * kTimeStep).rise(1.0), usual, 0.01 * usual);
}

TEST(LikelihoodProfile, EndsWhereIterationsDecideNothing) {
  const TiltProblem problem(10.0, 0.0, 300.0);
  const auto simulated = [&](double needed, double& rise) {
    const auto before = problem.evaluator.simulated();
    rise = problem.rise(1.0, needed);
    return problem.evaluator.simulated() - before;
  };
  double exact = 0.0, rough = 0.0;
  const auto all = simulated(1.0, exact);
  EXPECT_LT(simulated(exact, rough), all);
  EXPECT_GE(rough, exact);
  EXPECT_NEAR(rough, exact, 0.05 * exact);
}

TEST(Detectability, WhatIsImitatedNotLinearlyMustBeLarger) {
  const double linear = TiltProblem(0.0).smallest_visible().first;
  const double needed = TiltProblem(0.0).rise(linear / kDose);
  ASSERT_GT(needed, 10.0);
  for (const double lost : {0.05, 0.2, 0.3, 0.5}) {  // at that size
    const TiltProblem problem(lost * std::pow(kDose / linear, 2));
    const auto [smallest, shows] = problem.smallest_visible();
    EXPECT_TRUE(shows) << lost;
    EXPECT_GT(problem.rise(smallest / kDose), 0.89 * needed) << lost;
  }
}

TEST(Detectability, WhatNothingIsLeftOfIsNotVisible) {
  const double linear = TiltProblem(0.0).smallest_visible().first;
  EXPECT_TRUE(TiltProblem(0.0).smallest_visible().second);
  EXPECT_FALSE(TiltProblem(std::pow(kDose / linear, 2)).smallest_visible().second);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
