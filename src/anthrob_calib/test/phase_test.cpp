#include "anthrob_calib/discovery/phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "anthrob_calib/discovery/chain_experiment.h"
#include "anthrob_sim/effects/catalogue.h"
#include "arm.h"

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

TEST(Phase, AWrongOneIsLeft) {
  constexpr double kAmplitude = 3e-3, kPhase = 0.4;
  const std::string place = "biceps_brachii";
  const auto cogging = [&](double phase) {
    return EffectInstance{"cogging",
                          place,
                          {{"sine", kAmplitude * std::cos(phase)},
                           {"cosine", kAmplitude * std::sin(phase)},
                           {"periods", 12.0}}};
  };
  const Arm arm;
  const Evaluator evaluator(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml", {}, 0.001, 2);
  const Experiments experiments = {std::make_shared<ChainExperiment>(
      *arm.plain, arm.record({cogging(kPhase)}, 1, 1), ExperimentOptions{})};
  const auto size = static_cast<Eigen::Index>(experiments.front()->size());
  const ModelFit fit(evaluator, experiments, Eigen::VectorXf::Ones(size));
  const auto candidates = list_candidates(evaluator, {"cogging"});
  const auto candidate = std::find_if(candidates.begin(), candidates.end(),
                                      [&](const Candidate& c) { return c.place == place; });
  ASSERT_NE(candidate, candidates.end());
  const auto fitted = [&](double phase) {
    Variant variant;
    variant.effects = {cogging(phase)};
    return fit.start(variant, {});
  };
  for (const double off : {0.75 * M_PI, M_PI}) {
    const auto better = better_phase(fit, *candidate, fitted(kPhase + off));
    ASSERT_TRUE(better) << off;
    const double sine = better->parameters.at("sine"), cosine = better->parameters.at("cosine");
    EXPECT_NEAR(std::hypot(sine, cosine), kAmplitude, 1e-9);
    EXPECT_GT(std::cos(std::atan2(cosine, sine) - kPhase), 0.99) << off;
  }
  EXPECT_FALSE(better_phase(fit, *candidate, fitted(kPhase)));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
