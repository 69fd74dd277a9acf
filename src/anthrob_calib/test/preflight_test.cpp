#include "anthrob_calib/discovery/preflight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_calib/discovery/likelihood_profile.h"

namespace anthrob {
namespace discovery {
namespace {

constexpr double kDose = 0.03;      // of a tilt [rad]
constexpr double kDamping = 0.15;   // of the model's shoulder [Nms/rad]
constexpr std::size_t kBins = 500;  // of each channel

/// A tilt of gravity by t doses and a shoulder's damping that is d too high, in tenths of its
/// range, show as 20 (t - d) in one channel, so that d follows t, and as t - cubic d^3 and a
/// constant in another one.
class Tilted final : public Experiment {
 public:
  Tilted(double cubic, double constant) : cubic_(cubic), constant_(constant) {
    channels_ = {{"shoulder", "position", "rad", 0, 0, kBins, 0.0},
                 {"elbow", "position", "rad", 0, kBins, kBins, 0.0}};
    present_.assign(2 * kBins, 1);
    bin_ = 0.02;
    duration_ = bin_ * kBins;
  }

  void compare(const std::shared_ptr<const RobotModel>& model, Starts&, float* out) const override {
    const double t = std::asin(model->gravity.y() / model->gravity.norm()) / kDose;
    const auto shoulder = static_cast<std::size_t>(model->skeleton->find_joint("shoulder"));
    const double d = (model->skeleton->joints[shoulder].friction.viscous - kDamping) / 0.1;
    const double shown[] = {20.0 * (t - d), t - cubic_ * d * d * d + constant_};
    for (std::size_t b = 0; b < 2 * kBins; ++b) out[b] = static_cast<float>(shown[b / kBins]);
  }

 private:
  double cubic_, constant_;
};

struct TiltProblem {
  explicit TiltProblem(double cubic, double constant = 0.0)
      : evaluator(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml",
                  {{"joints.shoulder.friction.viscous", "Nms/rad", kDamping, -10.0, 10.0, 0.01}},
                  0.001, 1),
        fit(evaluator, {std::make_shared<Tilted>(cubic, constant)},
            Eigen::VectorXf::Ones(2 * kBins)),
        judge(fit.experiments(), fit.whitening(), {}),
        candidates(list_candidates(evaluator, {"gravity_tilt"})),
        base(fit.start(Variant{{kDamping}}, nuisance_unknowns(evaluator))) {}

  Visibility of_x() const {
    Excerpt all{fit.experiments(), {}};
    for (Eigen::Index b = 0; b < base.residual.size(); ++b) all.rows.push_back(b);
    const Screening screening(fit, base, candidates, all, all);
    Answer answer;
    PreFlight(candidates, fit, base, judge, judge, kBins * 0.02)
        .fly(screening, screening.scores(base), answer);
    for (const Visibility& v : answer.visible) {
      if (v.place == "x") return v;
    }
    return {};
  }

  Evaluator evaluator;
  ModelFit fit;
  Judge judge;
  std::vector<Candidate> candidates;
  Fitted base;
};

TEST(LikelihoodProfile, IsWhatOrdinaryParametersCannotTakeUp) {
  for (const double cubic : {0.0, 0.5}) {
    // The constant is higher on one side by as much as lower on the other.
    const TiltProblem problem(cubic, 0.5);
    ASSERT_EQ(problem.candidates.at(0).place, "x");
    const auto rise = profile_rise(problem.fit, problem.base, problem.candidates[0], 0, 1.0);
    ASSERT_TRUE(rise);
    EXPECT_NEAR(*rise, 0.5 * kBins * std::pow(1.0 - cubic, 2), 0.02 * 0.5 * kBins);
  }
}

TEST(PreFlight, WhatIsImitatedNotLinearlyMustBeLarger) {
  const double linear = TiltProblem(0.0).of_x().smallest_visible;
  ASSERT_GT(linear, 0.0);
  // Half of what is reckoned at that size is left: it must be twice as large.
  const double cubic = 0.5 * std::pow(kDose / linear, 2);
  EXPECT_NEAR(TiltProblem(cubic).of_x().smallest_visible, 2.0 * linear, 0.05 * linear);
}

TEST(PreFlight, WhatNothingIsLeftOfIsNotVisible) {
  const double linear = TiltProblem(0.0).of_x().smallest_visible;
  EXPECT_EQ(TiltProblem(std::pow(kDose / linear, 2)).of_x().smallest_visible, 0.0);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
