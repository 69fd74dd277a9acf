#include "anthrob_calib/discovery/naming.h"

#include <gtest/gtest.h>

#include "anthrob_calib/discovery/reduction.h"
#include "anthrob_calib/discovery/settling.h"
#include "anthrob_sim/effects/catalogue.h"
#include "made_experiment.h"

namespace anthrob {
namespace discovery {
namespace {

TEST(BestOfKinds, OneEffectDoesNotCrowdOutTheOthers) {
  const Effect *const a = all_effects()[0], *const b = all_effects()[1];
  const std::vector<const Effect*> kinds = {a, a, a, a, b, a, b};
  using Places = std::vector<std::size_t>;
  EXPECT_EQ(best_of_kinds(kinds, 2, 4), (Places{0, 1, 4, 6}));
  EXPECT_EQ(best_of_kinds(kinds, 2, 6), (Places{0, 1, 4, 6, 2, 3}));
  EXPECT_EQ(best_of_kinds(kinds, 7, 3), (Places{0, 1, 2}));
  EXPECT_EQ(best_of_kinds({}, 2, 4), Places{});
}

TEST(ShareOfSimpler, FewerSizesOrEverywhereInsteadOfSomewhere) {
  const auto candidate = [](const char* id, const char* place, std::size_t sizes) {
    const Effect* effect = find_effect(id);
    EffectParameter size;
    size.kind = EffectParameter::kSize;
    return Candidate{effect, place, std::vector<EffectParameter>(sizes, size), {}};
  };
  const Candidate everywhere = candidate("eyelet_friction", "biceps_brachii", 1),
                  somewhere = candidate("eyelet_friction", "biceps_brachii/2", 1);
  EXPECT_EQ(share_of_simpler(everywhere, somewhere), 0.98);
  EXPECT_EQ(share_of_simpler(somewhere, everywhere), 1.0);
  EXPECT_EQ(share_of_simpler(candidate("eyelet_friction", "biceps", 1), somewhere), 1.0);
  EXPECT_EQ(share_of_simpler(candidate("eyelet_presliding", "biceps_brachii", 1), somewhere), 1.0);
  // There, "MUSCLE" is its last segment.
  EXPECT_EQ(share_of_simpler(candidate("wrapping_surface", "biceps_brachii", 1),
                             candidate("wrapping_surface", "biceps_brachii/2", 1)),
            1.0);
  const Candidate coulomb = candidate("joint_coulomb", "elbow", 1),
                  asymmetric = candidate("joint_coulomb_asymmetric", "elbow", 2);
  EXPECT_EQ(share_of_simpler(coulomb, asymmetric), 0.75);
  EXPECT_EQ(share_of_simpler(asymmetric, coulomb), 1.0);
  EXPECT_EQ(share_of_simpler(candidate("joint_coulomb", "shoulder", 1), asymmetric), 1.0);
}

/// Ten seconds to learn from and ten to judge by, of a robot whose shoulder's damping is free and
/// whose elbow may have more than the model says.
struct Problem {
  using Law = MadeExperiment::Law;

  explicit Problem(const Law& law, const std::string& free = "shoulder")
      : evaluator(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml",
                  {{"joints." + free + ".friction.viscous", "Nms/rad", 0.15, 0.0, 1.0, 0.01}},
                  MadeExperiment::kStep, 1),
        train(evaluator, {std::make_shared<MadeExperiment>(law, law, kBins, 1)},
              Eigen::VectorXf::Ones(kBins), MadeExperiment::kCoarse),
        test(evaluator, {std::make_shared<MadeExperiment>(law, law, kBins, 2)},
             Eigen::VectorXf::Ones(kBins)),
        train_judge(train.experiments(), train.whitening(), {}),
        test_judge(test.experiments(), test.whitening(), {}),
        candidates(list_candidates(evaluator, {"joint_viscous"})),
        naming(train, test, train_judge, test_judge, candidates, 1) {}

  Fitted base(double damping) const {
    return train.start(Variant{{damping}}, nuisance_unknowns(evaluator));
  }
  std::size_t index(const std::string& joint) const {
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      if (candidates[c].place == joint) return c;
    }
    throw std::invalid_argument(joint);
  }
  ShortList weigh(const Fitted& base, const std::string& joint, double amount) const {
    Score score;
    score.candidate = index(joint);
    score.gain = 1.0;
    score.amount = {amount};
    return naming.weigh(base, test.residual(base.variant), {score});
  }

  static constexpr Eigen::Index kBins = 500;
  Evaluator evaluator;
  ModelFit train, test;
  Judge train_judge, test_judge;
  std::vector<Candidate> candidates;
  Naming naming;
};

constexpr double kElbow = 0.02, kDose = 0.05;  // damping in the model, of the catalogue [Nms/rad]

TEST(Naming, WhatDoesNothingAtFirstIsTriedWhereItBegins) {
  // Nothing up to seven tenths of a dose; a third of what the whole one does is asked for, so that
  // in proportion a third of the dose would be, where the slope is none.
  const Problem problem([](double elbow, double) {
    const double amount = (elbow - kElbow) / kDose;
    return 10.0 * (std::max(0.0, amount - 0.7) / 0.3 - 0.34);
  });
  const ShortList list = problem.weigh(problem.base(0.15), "elbow", 0.34);
  ASSERT_EQ(list.named.size(), 1u);
  EXPECT_NEAR(list.named[0].fit.variant.effects[0].parameters.at("damping"),
              (0.7 + 0.34 * 0.3) * kDose, 0.02 * kDose);
  EXPECT_GT(list.named[0].probability, 0.99);
}

TEST(Naming, FitsFollowABaseThatFoundABetterValley) {
  // The shoulder's damping has a valley where the search begins and a deeper one.
  const Problem problem([](double elbow, double shoulder) {
    const double valley = shoulder < 0.5 ? 4.0 + 50.0 * std::abs(shoulder - 0.15)
                                         : 1.0 + 50.0 * std::abs(shoulder - 0.8);
    return valley - 1.0 * (elbow - kElbow) / kDose;
  });
  ShortList list = problem.weigh(problem.base(0.15), "elbow", 1.0);
  ASSERT_EQ(list.named.size(), 1u);
  // Stuck half way, as rugged ground may have it.
  Named& stuck = list.named[0];
  Variant half = stuck.fit.variant;
  half.effects[0].parameters["damping"] = 2.0 * kDose;
  ASSERT_TRUE(problem.train.move(stuck.fit, half));
  stuck.test = problem.test.residual(half);
  const Fitted better = problem.base(0.8);
  const Eigen::VectorXf test = problem.test.residual(better.variant);
  ASSERT_LT(better.cost, stuck.fit.cost);
  problem.naming.judge(better, test, list);
  EXPECT_LT(list.named[0].probability, 0.01);
  problem.naming.follow(better, test, list);
  EXPECT_LT(list.named[0].fit.cost, better.cost - 100.0);
  EXPECT_GT(list.named[0].probability, 0.99);
}

TEST(Naming, OddsAreEvenForTheSame) {
  const Problem problem([](double, double shoulder) { return 20.0 * (shoulder - 0.15); });
  const auto test = [&](const Fitted& fitted) { return problem.test.residual(fitted.variant); };
  const Fitted good = problem.base(0.15), bad = problem.base(0.25);
  EXPECT_NEAR(problem.naming.odds(good, test(good), good, test(good)), 0.5, 1e-9);
  EXPECT_GT(problem.naming.odds(good, test(good), bad, test(bad)), 0.99);
  EXPECT_LT(problem.naming.odds(bad, test(bad), good, test(good)), 0.01);
}

TEST(WithoutEffect, OthersStayAsTheyAre) {
  const Problem problem([](double elbow, double shoulder) { return elbow + 10.0 * shoulder; });
  const std::size_t elbow = problem.index("elbow"), shoulder = problem.index("shoulder");
  Fitted fitted = problem.base(0.15);
  for (const auto& [candidate, damping] : {std::pair(elbow, 0.3), std::pair(shoulder, 0.4)}) {
    Variant variant = fitted.variant;
    variant.effects.push_back(problem.candidates[candidate].neutral());
    variant.effects.back().parameters["damping"] = damping;
    Unknown u;
    u.effect = static_cast<int>(variant.effects.size()) - 1;
    u.parameter = "damping";
    u.upper = 10.0;
    fitted = problem.train.extend(fitted, variant, {u});
  }
  const auto reduced =
      without_effect(problem.evaluator, problem.train, fitted, 0, problem.candidates[elbow]);
  ASSERT_TRUE(reduced);
  ASSERT_EQ(reduced->variant.effects.size(), 1u);
  EXPECT_EQ(reduced->variant.effects[0].place, "shoulder");
  EXPECT_EQ(reduced->variant.effects[0].parameters.at("damping"), 0.4);
  ASSERT_EQ(reduced->unknowns.size(), 2u);
  EXPECT_EQ(reduced->unknowns[1].effect, 0);
  EXPECT_EQ(reduced->sensitivity.col(1), fitted.sensitivity.col(2));
  EXPECT_NEAR(reduced->residual[0], fitted.residual[0] - 0.3, 1e-5);
}

TEST(WithoutEffect, WhatIsTheSameQuantityTakesItOver) {
  const Problem problem([](double elbow, double) { return elbow; }, "elbow");
  const std::size_t elbow = problem.index("elbow");
  ASSERT_EQ(problem.candidates[elbow].same_as.size(), 1u);
  const Fitted base = problem.base(0.15);
  const ShortList list = problem.weigh(base, "elbow", 1.0);
  ASSERT_EQ(list.named.size(), 1u);
  const Fitted& fitted = list.named[0].fit;
  EXPECT_EQ(fitted.unknowns[0].lower, fitted.unknowns[0].upper);  // held
  const auto reduced =
      without_effect(problem.evaluator, problem.train, fitted, 0, problem.candidates[elbow]);
  ASSERT_TRUE(reduced);
  EXPECT_EQ(reduced->residual, fitted.residual);
  EXPECT_LT(reduced->unknowns[0].lower, reduced->unknowns[0].upper);
}

TEST(Settling, WhatStaysOutOfReachIsNotSettled) {
  const Problem problem([](double, double shoulder) { return 3.0 + 10.0 * (shoulder - 0.4); });
  const Settling settling(problem.evaluator, problem.train, problem.train_judge);
  Fitted far = problem.base(0.15), near = far;
  EXPECT_FALSE(settling.settle_within_reach(far, 0.0));
  EXPECT_TRUE(settling.settle_within_reach(near, 1000.0));
  EXPECT_LT(near.cost, 500.0);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
