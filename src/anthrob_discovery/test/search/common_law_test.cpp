#include "search/common_law.h"

#include <gtest/gtest.h>

#include "made_problem.h"
#include "offset_forces.h"

namespace anthrob {
namespace discovery {
namespace {

/// The first two muscles are named, each by itself.
struct TwoNamed {
  explicit TwoNamed(const OffsetForces::Offsets& truth)
      : problem({}, std::make_shared<OffsetForces>(truth, 1),
                std::make_shared<OffsetForces>(truth, 2), {kLaw}),
        with(problem.hypotheses.tested(problem.train.start({}, {}))),
        whole(all_of(problem.train)),
        screening(problem.train, with.fit, problem.candidates, whole, whole, {}),
        common(problem.hypotheses, screening) {
    for (std::size_t e = 0; e < 2; ++e) {
      Score score;
      score.candidate = problem.index(kMuscles[e], kLaw);
      score.gain = 1.0;
      score.amount = {1.0, 0.0};
      with = problem.comparison.weigh(with, {score}).entries.at(0);
      parts.push_back({e, score.candidate});
    }
  }

  MadeProblem problem;
  Tested with;
  Excerpt whole;
  Screening screening;
  CommonLaw common;
  std::vector<CommonLaw::Part> parts;
};

TEST(CommonLaw, OneLawAtSeveralPlacesMayBeEverywhere) {
  const TwoNamed two({{"brachialis", 4.0}, {"biceps_brachii", 4.0}, {"triceps_brachii", 4.0}});
  const std::size_t all = two.problem.index("all", kLaw);
  EXPECT_EQ(two.common.everywhere(two.parts), all);
  EXPECT_FALSE(two.common.everywhere({two.parts[0]}));
  EXPECT_FALSE(two.common.everywhere({two.parts[0], {1, all}}));
  const auto instead = two.common.instead(all, two.with, two.parts);
  ASSERT_TRUE(instead);
  EXPECT_TRUE(instead->is_clearly_better({}));
  const auto& effects = instead->tested.fit.variant.effects;
  ASSERT_EQ(effects.size(), 1u);
  EXPECT_EQ(effects[0].place, "all");
  EXPECT_NEAR(effects[0].parameters.at("offset"), 4.0, 0.1);
  // What it explains is there without it.
  EXPECT_GT(instead->without.squaredNorm(), 2.0f * instead->tested.test.squaredNorm());
}

TEST(CommonLaw, WhatIsAtTwoPlacesOnlyIsNotEverywhere) {
  TwoNamed two({{"brachialis", 4.0}, {"biceps_brachii", 4.0}, {"triceps_brachii", 0.0}});
  const auto instead = two.common.instead(two.problem.index("all", kLaw), two.with, two.parts);
  EXPECT_FALSE(instead && instead->is_better({}));
}

TEST(CommonLaw, IsNotFittedToTheEndWhereItCannotReachWhatIsNamed) {
  const auto simulations = [](double third) {
    TwoNamed two({{"brachialis", 4.0}, {"biceps_brachii", 4.0}, {"triceps_brachii", third}});
    const auto before = two.problem.evaluator.simulated();
    EXPECT_TRUE(two.common.instead(two.problem.index("all", kLaw), two.with, two.parts));
    return two.problem.evaluator.simulated() - before;
  };
  // To the end, both would take more than three quarters of the latter.
  EXPECT_LT(simulations(1.0), 0.75 * static_cast<double>(simulations(4.0)));
}

TEST(CommonLaw, WhatDiffersFromPlaceToPlaceIsNotOneLaw) {
  TwoNamed two({{"brachialis", 6.0}, {"biceps_brachii", 2.0}, {"triceps_brachii", 0.0}});
  const auto instead = two.common.instead(two.problem.index("all", kLaw), two.with, two.parts);
  EXPECT_FALSE(instead && instead->is_better({}));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
