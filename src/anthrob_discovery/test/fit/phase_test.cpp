#include "fit/phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "anthrob_sim/effects/catalogue.h"
#include "arm.h"
#include "experiment/chain_experiment.h"
#include "hypotheses/trials.h"

namespace anthrob {
namespace discovery {
namespace {

TEST(Phase, IsOfTwoSizesOfEitherSignAndOneUnit) {
  const auto candidate = [](const char* id) {
    const Effect* effect = find_effect(id);
    return Candidate{effect, "", effect->info().parameters, {}};
  };
  EXPECT_TRUE(has_phase(candidate("cogging")));
  EXPECT_FALSE(has_phase(candidate("joint_coulomb_asymmetric")));
  EXPECT_FALSE(has_phase(candidate("joint_offset_torque")));
  EXPECT_FALSE(has_phase(candidate("force_sensor_offset")));  // N, and N/s
}

TEST(Phase, OthersAreQuartersOfATurn) {
  const Effect* effect = find_effect("cogging");
  const Candidate cogging{effect, "", effect->info().parameters, {}};
  const auto sizes = cogging.sizes();
  const double sine = sizes[0]->typical, cosine = sizes[1]->typical;  // a dose each [Nm]
  ASSERT_NE(sine, cosine);
  const double amplitude = std::hypot(3.0 * sine, 1.0 * cosine);
  const auto turned = other_phases(cogging, {3.0, 1.0});
  ASSERT_EQ(turned.size(), 3u);
  for (std::size_t quarter = 0; quarter < 3; ++quarter) {
    const double phase =
        std::atan2(1.0 * cosine, 3.0 * sine) + static_cast<double>(quarter + 1) * M_PI_2;
    EXPECT_NEAR(turned[quarter][0] * sine, amplitude * std::cos(phase), 1e-12);
    EXPECT_NEAR(turned[quarter][1] * cosine, amplitude * std::sin(phase), 1e-12);
  }
}

/// The arm with cogging in the motor of its biceps, and what looks for that.
class Cogging : public testing::Test {
 protected:
  static constexpr double kAmplitude = 3e-3, kPhase = 0.4;  // [Nm], [rad]
  const std::string place_ = "biceps_brachii";

  EffectInstance cogging(double phase) const {
    return {"cogging",
            place_,
            {{"sine", kAmplitude * std::cos(phase)},
             {"cosine", kAmplitude * std::sin(phase)},
             {"periods", 12.0}}};
  }
  Fitted fitted(const std::vector<EffectInstance>& effects) const {
    Variant variant;
    variant.effects = effects;
    return fit_.start(variant, {});
  }

  const Arm arm_;
  const Evaluator evaluator_{ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml", {}, 0.001, 2};
  const Experiments experiments_ = {
      make_experiment(*arm_.plain, arm_.record({cogging(kPhase)}, 1, 1), {})};
  const ModelFit fit_{evaluator_,
                      experiments_,
                      Eigen::VectorXf::Ones(static_cast<Eigen::Index>(experiments_[0]->size())),
                      {}};
  const std::vector<Candidate> candidates_ = list_candidates(evaluator_, {"cogging"});
  const std::size_t candidate_ =
      static_cast<std::size_t>(std::find_if(candidates_.begin(), candidates_.end(),
                                            [&](const Candidate& c) { return c.place == place_; }) -
                               candidates_.begin());
};

TEST_F(Cogging, OfAWrongPhaseIsLeft) {
  for (const double off : {0.75 * M_PI, M_PI}) {
    const auto better =
        better_phase(fit_, candidates_[candidate_], fitted({cogging(kPhase + off)}));
    ASSERT_TRUE(better) << off;
    const double sine = better->parameters.at("sine"), cosine = better->parameters.at("cosine");
    EXPECT_NEAR(std::hypot(sine, cosine), kAmplitude, 1e-9);
    EXPECT_GT(std::cos(std::atan2(cosine, sine) - kPhase), 0.99) << off;
  }
  EXPECT_FALSE(better_phase(fit_, candidates_[candidate_], fitted({cogging(kPhase)})));
}

TEST_F(Cogging, IsTriedInOtherPhasesThanAreSuggested) {
  const auto sizes = candidates_[candidate_].sizes();
  Score suggested;
  suggested.candidate = candidate_;
  suggested.gain = 100.0;
  for (const EffectParameter* size : sizes) {
    const double opposite = cogging(kPhase + M_PI).parameters.at(size->name);
    suggested.amount.push_back(opposite / size->typical);
  }
  for (const Score& best : Trials(fit_, candidates_, {}).best(fitted({}), {suggested})) {
    if (best.candidate != candidate_) continue;
    const double sine = best.amount[0] * sizes[0]->typical,
                 cosine = best.amount[1] * sizes[1]->typical;
    EXPECT_GT(std::cos(std::atan2(cosine, sine) - kPhase), 0.7);
    return;
  }
  FAIL() << "not even tried";
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
