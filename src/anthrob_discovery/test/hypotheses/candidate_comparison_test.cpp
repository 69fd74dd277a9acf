#include "hypotheses/candidate_comparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "anthrob_sim/effects/catalogue.h"
#include "fit/bootstrap.h"
#include "fit/reduction.h"
#include "hypotheses/screening.h"
#include "hypotheses/trials.h"
#include "made_problem.h"
#include "search/backward_elimination.h"
#include "search/final_comparison.h"
#include "search/scatter.h"

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
  EXPECT_EQ(share_of_simpler(everywhere, somewhere, {}), 0.98);
  EXPECT_EQ(share_of_simpler(somewhere, everywhere, {}), 1.0);
  EXPECT_EQ(share_of_simpler(candidate("eyelet_friction", "biceps", 1), somewhere, {}), 1.0);
  EXPECT_EQ(share_of_simpler(candidate("eyelet_presliding", "biceps_brachii", 1), somewhere, {}),
            1.0);
  // There, "MUSCLE" is its last segment.
  EXPECT_EQ(share_of_simpler(candidate("wrapping_surface", "biceps_brachii", 1),
                             candidate("wrapping_surface", "biceps_brachii/2", 1), {}),
            1.0);
  const Candidate coulomb = candidate("joint_coulomb", "elbow", 1),
                  asymmetric = candidate("joint_coulomb_asymmetric", "elbow", 2);
  EXPECT_EQ(share_of_simpler(coulomb, asymmetric, {}), 0.75);
  EXPECT_EQ(share_of_simpler(asymmetric, coulomb, {}), 1.0);
  // Of as many sizes, but what the other becomes over long ways.
  const Candidate presliding = candidate("joint_presliding", "elbow", 1);
  EXPECT_EQ(share_of_simpler(coulomb, presliding, {}), 0.75);
  EXPECT_EQ(share_of_simpler(presliding, coulomb, {}), 1.0);
  const Candidate lugre = candidate("joint_lugre", "elbow", 1);
  EXPECT_EQ(share_of_simpler(presliding, lugre, {}), 0.75);
  EXPECT_EQ(share_of_simpler(coulomb, lugre, {}), 0.75);
  EXPECT_EQ(share_of_simpler(lugre, presliding, {}), 1.0);
  EXPECT_EQ(share_of_simpler(candidate("joint_coulomb", "shoulder", 1), asymmetric, {}), 1.0);
}

/// Ten seconds to learn from and ten to judge by, of a robot whose shoulder's damping is free and
/// whose elbow may have more than the model says.
struct ElbowProblem : MadeProblem {
  using Law = MadeExperiment::Law;

  explicit ElbowProblem(const Law& law, const std::string& free = "shoulder",
                        const std::vector<std::string>& effects = {"joint_viscous"})
      : MadeProblem(free.empty()
                        ? std::vector<ModelParameter>{}
                        : std::vector<ModelParameter>{{"joints." + free + ".friction.viscous",
                                                       "Nms/rad", 0.15, 0.0, 1.0, 0.01}},
                    std::make_shared<MadeExperiment>(law, law, kBins, 1),
                    std::make_shared<MadeExperiment>(law, law, kBins, 2), effects,
                    MadeExperiment::kCoarse) {}

  Fitted fitted(double damping) const {
    return train.start(Variant{{damping}}, nuisance_unknowns(evaluator));
  }
  Tested base(double damping) const { return hypotheses.tested(fitted(damping)); }
  /// With one more effect, its damping free.
  Fitted with(const Fitted& fitted, std::size_t candidate, double damping) const {
    Variant variant = fitted.variant;
    variant.effects.push_back(candidates[candidate].neutral());
    variant.effects.back().parameters["damping"] = damping;
    Unknown u;
    u.effect = static_cast<int>(variant.effects.size()) - 1;
    u.parameter = "damping";
    u.upper = 10.0;
    u.scale = u.finest = 0.01;
    u.neutral = 0.0;
    return train.extend(fitted, variant, {u});
  }
  std::size_t index(const std::string& place, const std::string& id = "joint_viscous") const {
    return MadeProblem::index(place, id);
  }
  ShortList weigh(const Tested& base, const std::string& joint, double amount) const {
    Score score;
    score.candidate = index(joint);
    score.gain = 1.0;
    score.amount = {amount};
    return comparison.weigh(base, {score});
  }

  static constexpr Eigen::Index kBins = 500;
};

constexpr double kElbow = 0.02,
                 kCatalogueDose = 0.05;  // damping in the model, of the catalogue [Nms/rad]

TEST(CandidateComparison, WhatDoesNothingAtFirstIsTriedWhereItBegins) {
  // Up to seven tenths of a dose nothing happens, and the data ask for a third of what a whole dose
  // does. In proportion that would be a third of a dose, where the slope is zero.
  const ElbowProblem problem([](double elbow, double, double) {
    const double amount = (elbow - kElbow) / kCatalogueDose;
    return 10.0 * (std::max(0.0, amount - 0.7) / 0.3 - 0.34);
  });
  const ShortList list = problem.weigh(problem.base(0.15), "elbow", 0.34);
  ASSERT_EQ(list.entries.size(), 1u);
  EXPECT_NEAR(list.entries[0].fit.variant.effects[0].parameters.at("damping"),
              (0.7 + 0.34 * 0.3) * kCatalogueDose, 0.02 * kCatalogueDose);
  EXPECT_GT(list.entries[0].probability, 0.99);
}

TEST(CandidateComparison, WhatIsManyDosesIsNotTakenForAWeakOne) {
  // Half a dose is a little better than none, a few are worse; ten are what there is.
  const ElbowProblem problem([](double elbow, double, double) {
    const double amount = (elbow - kElbow) / kCatalogueDose;
    return amount < 3.0 ? 5.0 + std::pow(amount - 0.5, 2) : 11.25 * (10.0 - amount) / 7.0;
  });
  const ShortList list = problem.weigh(problem.base(0.15), "elbow", 0.5);
  ASSERT_EQ(list.entries.size(), 1u);
  EXPECT_NEAR(list.entries[0].fit.variant.effects[0].parameters.at("damping"),
              10.0 * kCatalogueDose, 0.1 * kCatalogueDose);
  EXPECT_GT(list.entries[0].probability, 0.99);
}

TEST(CandidateComparison, WhatPointsTheWrongWayAtFirstIsTriedWhereEvidenceIs) {
  // A dose of damping makes it worse, three are what is missing. Dry friction says a little.
  const ElbowProblem problem(
      [](double elbow, double, double dry) {
        const double doses = (elbow - kElbow) / kCatalogueDose;
        return 4.0 - std::min(1.0, dry / 0.1) + (doses < 1.0 ? 2.0 * doses : 5.0 - 3.0 * doses);
      },
      "shoulder", {"joint_viscous", "joint_coulomb"});
  std::vector<Score> scores(2);
  scores[0].candidate = problem.index("elbow", "joint_coulomb");
  scores[0].gain = 1.0;
  scores[0].amount = {0.5};
  scores[1].candidate = problem.index("elbow");
  scores[1].amount = {0.0};
  const ShortList list = problem.comparison.weigh(problem.base(0.15), scores);
  ASSERT_EQ(list.entries.size(), 2u);
  EXPECT_EQ(list.entries[0].candidate, scores[1].candidate);
  EXPECT_NEAR(list.entries[0].fit.variant.effects[0].parameters.at("damping"), 3.0 * kCatalogueDose,
              0.1 * kCatalogueDose);
}

TEST(CandidateComparison, WithoutOrdinaryParameters) {
  const ElbowProblem problem(
      [](double elbow, double, double) { return 5.0 - 10.0 * (elbow - kElbow) / kCatalogueDose; },
      "");
  const Tested base = problem.hypotheses.tested(problem.train.start(Variant{}, {}));
  EXPECT_TRUE(bootstrap_intervals(base.fit, problem.train.experiments(), {}, 1, {}, 2.0).empty());
  const ShortList list = problem.weigh(base, "elbow", 1.0);
  ASSERT_EQ(list.entries.size(), 1u);
  EXPECT_NEAR(list.entries[0].fit.variant.effects[0].parameters.at("damping"), 0.5 * kCatalogueDose,
              0.02 * kCatalogueDose);
}

TEST(CandidateComparison, FitsFollowABaseThatFoundABetterValley) {
  // The shoulder's damping has a valley where the search begins and a deeper one.
  const ElbowProblem problem([](double elbow, double shoulder, double) {
    const double valley = shoulder < 0.5 ? 4.0 + 50.0 * std::abs(shoulder - 0.15)
                                         : 1.0 + 50.0 * std::abs(shoulder - 0.8);
    return valley - 1.0 * (elbow - kElbow) / kCatalogueDose;
  });
  ShortList list = problem.weigh(problem.base(0.15), "elbow", 1.0);
  ASSERT_EQ(list.entries.size(), 1u);
  // Stuck half way, as rugged ground may have it.
  FittedCandidate& stuck = list.entries[0];
  Variant half = stuck.fit.variant;
  half.effects[0].parameters["damping"] = 2.0 * kCatalogueDose;
  ASSERT_TRUE(problem.train.move(stuck.fit, half));
  stuck.test = problem.test.residual(half);
  const Tested better = problem.base(0.8);
  ASSERT_LT(better.fit.cost, stuck.fit.cost);
  problem.comparison.judge(better, list);
  EXPECT_LT(list.entries[0].probability, 0.01);
  problem.comparison.follow(better, list);
  EXPECT_LT(list.entries[0].fit.cost, better.fit.cost - 100.0);
  EXPECT_GT(list.entries[0].probability, 0.99);
}

TEST(CandidateComparison, OddsAreOfWhatWasNotLearnedFrom) {
  const ElbowProblem problem(
      [](double, double shoulder, double) { return 20.0 * (shoulder - 0.15); });
  const Eigen::VectorXf good = problem.base(0.15).test, bad = problem.base(0.25).test;
  EXPECT_NEAR(problem.comparison.odds(good, good).probability, 0.5, 1e-9);
  EXPECT_EQ(problem.comparison.odds(good, good).evidence, 0.0);
  EXPECT_GT(problem.comparison.odds(good, bad).probability, 0.99);
  EXPECT_LT(problem.comparison.odds(bad, good).probability, 0.01);
  // 2 more than none in each of 500 bins that have a noise of 1.
  EXPECT_NEAR(problem.comparison.odds(good, bad).evidence, 0.5 * 500 * 4.0, 250.0);
  EXPECT_NEAR(problem.comparison.odds(bad, good).evidence, -0.5 * 500 * 4.0, 250.0);
}

TEST(WithoutEffect, OthersStayAsTheyAre) {
  const ElbowProblem problem(
      [](double elbow, double shoulder, double) { return elbow + 10.0 * shoulder; });
  const std::size_t elbow = problem.index("elbow"), shoulder = problem.index("shoulder");
  const Fitted fitted = problem.with(problem.with(problem.fitted(0.15), elbow, 0.3), shoulder, 0.4);
  const auto reduced = problem.hypotheses.without(0, elbow, fitted);
  ASSERT_TRUE(reduced);
  ASSERT_EQ(reduced->variant.effects.size(), 1u);
  EXPECT_EQ(reduced->variant.effects[0].place, "shoulder");
  EXPECT_EQ(reduced->variant.effects[0].parameters.at("damping"), 0.4);
  ASSERT_EQ(reduced->unknowns.size(), 2u);
  EXPECT_EQ(reduced->unknowns[1].effect, 0);
  EXPECT_EQ(reduced->sensitivity.col(1), fitted.sensitivity.col(2));
  EXPECT_NEAR(reduced->residual[0], fitted.residual[0] - 0.3, 1e-5);
}

TEST(WithLastEffectAt, IsTheSameFitInAnotherOrder) {
  const ElbowProblem problem(
      [](double elbow, double shoulder, double) { return elbow + 10.0 * shoulder; });
  const std::size_t elbow = problem.index("elbow"), shoulder = problem.index("shoulder");
  const Fitted both = problem.with(problem.with(problem.fitted(0.2), elbow, 0.03), shoulder, 0.07);
  const std::optional<Fitted> moved = with_last_effect_at(problem.train, both, 0);
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->variant.effects[0].place, "shoulder");
  EXPECT_EQ(moved->variant.effects[1].place, "elbow");
  EXPECT_NEAR(moved->cost, both.cost, 1e-9 * both.cost);
  for (std::size_t i = 0; i < both.unknowns.size(); ++i) {
    EXPECT_EQ(moved->unknowns[i].read(moved->variant), both.unknowns[i].read(both.variant)) << i;
  }
}

TEST(WithoutEffect, WhatIsTheSameQuantityTakesItOver) {
  const ElbowProblem problem([](double elbow, double, double) { return 30.0 * elbow; }, "elbow");
  const std::size_t elbow = problem.index("elbow");
  ASSERT_EQ(problem.candidates[elbow].same_as.size(), 1u);
  Fitted fitted = problem.weigh(problem.base(0.15), "elbow", 1.0).entries.at(0).fit;
  EXPECT_EQ(fitted.unknowns[0].lower, fitted.unknowns[0].upper);  // held
  problem.train.polish(fitted, 0);
  EXPECT_EQ(fitted.sensitivity.col(0).norm(), 0.0f);
  const auto reduced = problem.hypotheses.without(0, elbow, fitted);
  ASSERT_TRUE(reduced);
  EXPECT_EQ(reduced->residual, fitted.residual);
  EXPECT_LT(reduced->unknowns[0].lower, reduced->unknowns[0].upper);
  EXPECT_NEAR(reduced->sensitivity(0, 0), 30.0 * reduced->unknowns[0].scale, 1e-3);
}

TEST(Convergence, WhatStaysOutOfReachIsNotSettled) {
  const ElbowProblem problem(
      [](double, double shoulder, double) { return 5.0 + 50.0 * (shoulder - 0.8); });
  const Fitted begin = problem.fitted(0.15);
  ASSERT_GT(begin.cost, 100.0 * ElbowProblem::kBins);
  const auto simulated = [&](double level, bool within) {
    Fitted fitted = begin;
    const std::size_t before = problem.evaluator.simulated();
    EXPECT_EQ(problem.convergence.converge_within_reach(fitted, level), within);
    EXPECT_LT(fitted.cost, ElbowProblem::kBins);  // the noise alone: half of that
    return problem.evaluator.simulated() - before;
  };
  const std::size_t rough = simulated(0.0, false);
  EXPECT_GT(simulated(1e6, true), rough);
}

TEST(Convergence, WhatMissesByFarIsNotPolished) {
  const ElbowProblem problem(
      [](double, double shoulder, double) { return 20.0 + 50.0 * std::abs(shoulder - 0.8); });
  const auto simulated = [&](double level) {
    Fitted fitted = problem.fitted(0.75);
    const std::size_t before = problem.evaluator.simulated();
    EXPECT_FALSE(problem.convergence.converge_within_reach(fitted, level * ElbowProblem::kBins));
    return problem.evaluator.simulated() - before;
  };
  // 20 floors everywhere: 200 for every bin.
  EXPECT_LT(simulated(100.0), simulated(190.0));
}

/// Fits to the end from the far one of two valleys.
/// @param given, far what differs on their grounds; parameters are given in the first
/// @return simulations that it took
std::size_t finish_from_far(double given, double far, double level, bool within) {
  const ElbowProblem problem([=](double, double shoulder, double) {
    if (shoulder < 0.4) return 50.0 * std::abs(shoulder - 0.15) + given;
    return 50.0 * std::abs(shoulder - 0.7) + far;
  });
  const Fitted begin = problem.fitted(0.7);
  const std::size_t before = problem.evaluator.simulated();
  const auto end = problem.convergence.to_the_end_within_reach(begin, level * ElbowProblem::kBins);
  EXPECT_EQ(end.has_value(), within);
  if (end) {
    EXPECT_LT(end->cost,
              1.2 * ElbowProblem::kBins);  // half of its square, and as much of the noise
  }
  return problem.evaluator.simulated() - before;
}

TEST(Convergence, WhatLagsBehindIsNotFinished) {
  const std::size_t lost = finish_from_far(1.0, 3.0, 0.5, false);
  EXPECT_GT(finish_from_far(1.0, 3.0, 2.0, true), lost);  // near from the given parameters
  EXPECT_GT(finish_from_far(3.0, 1.0, 2.0, true), lost);  // near where it stood
}

TEST(Convergence, AFitFromTheGivenParametersEndsWhereItFallsBehind) {
  // The valley where parameters are given has a curved ground, so that it takes several rounds.
  const auto simulated = [](double left) {
    const ElbowProblem problem([left](double, double shoulder, double) {
      if (shoulder < 0.5) return left + 100.0 * (shoulder - 0.35) * (shoulder - 0.35);
      return 1.0 + 50.0 * std::abs(shoulder - 0.7);
    });
    const Fitted begin = problem.fitted(0.7);
    const std::size_t before = problem.evaluator.simulated();
    EXPECT_LE(problem.convergence.to_the_end(begin).cost, begin.cost);
    return problem.evaluator.simulated() - before;
  };
  EXPECT_LT(simulated(1.04), simulated(1.02));
}

/// Dry friction of the elbow is what is missing, and where the shoulder's damping is right it says
/// all 6. In another valley, where that has gone astray, it says less, and more damping of the
/// elbow says something.
ElbowProblem::Law hides_dry_friction(double dry_astray, double damping_astray) {
  return [=](double elbow, double shoulder, double dry) {
    const double rubs = std::min(1.0, dry / 0.1),
                 damped = std::min(1.0, (elbow - kElbow) / kCatalogueDose);
    if (shoulder < 0.4) return 50.0 * std::abs(shoulder - 0.15) + 6.0 - 6.0 * rubs;
    return 50.0 * std::abs(shoulder - 0.7) + 6.0 - dry_astray * rubs - damping_astray * damped;
  };
}

/// The short list of more damping of the elbow and dry friction there, a dose of each, and what the
/// final comparison makes of it.
struct TwoLaws {
  TwoLaws(const ElbowProblem::Law& law, double shoulder)
      : problem(law, "shoulder",
                {"joint_viscous", "joint_coulomb", "force_sensor_gain", "force_sensor_offset"}),
        base(problem.base(shoulder)) {
    for (const char* id : {"joint_viscous", "joint_coulomb"}) {
      Score score;
      score.candidate = problem.index("elbow", id);
      score.gain = score.uncertainty = 1.0;
      score.amount = {1.0};
      const ShortList one = problem.comparison.weigh(base, {score});
      list.entries.push_back(one.entries.at(0));
    }
    problem.comparison.judge(base, list);
  }
  void decide() {
    Gaps gaps(problem.train_judge, problem.test_judge, problem.candidates.size());
    gaps.begin(base.test);
    FinalComparison(problem.hypotheses, gaps).decide(base, list);
  }
  std::string id(std::size_t place) const {
    return problem.candidates[list.entries.at(place).candidate].effect->info().id;
  }

  ElbowProblem problem;
  Tested base;
  ShortList list;
};

TEST(FinalComparison, WhatIsBetterInTheEndIsFirst) {
  // Damping leaves 2 there and dry friction 3, but from the given 0.15 it leaves nothing.
  TwoLaws laws(hides_dry_friction(3.0, 4.0), 0.7);
  ASSERT_EQ(laws.id(0), "joint_viscous");
  const double rough = laws.list.entries[0].probability,
               rough_evidence = laws.list.entries[1].evidence;
  ASSERT_GT(rough, 0.99);
  laws.decide();
  EXPECT_EQ(laws.id(0), "joint_coulomb");
  EXPECT_NEAR(laws.list.entries[0].probability, rough, 0.01);
  EXPECT_LT(laws.list.entries[1].probability, 0.01);
  EXPECT_LT(laws.list.entries[0].fit.cost, ElbowProblem::kBins);
  // 3 more than none are left by the rough fit, nothing in the end.
  EXPECT_GT(laws.list.entries[0].evidence, rough_evidence + 0.4 * ElbowProblem::kBins);
}

TEST(FinalComparison, WhatLeavesMuchMoreIsNotFinished) {
  // Dry friction leaves 1 of a gap of 6.
  const auto simulated = [](double damping_leaves) {
    TwoLaws laws(
        [=](double elbow, double shoulder, double dry) {
          const double damped = std::min(1.0, (elbow - kElbow) / kCatalogueDose);
          return 6.0 + 50.0 * std::abs(shoulder - 0.15) -
                 std::max(5.0 * std::min(1.0, dry / 0.1), (6.0 - damping_leaves) * damped);
        },
        0.15);
    EXPECT_EQ(laws.id(0), "joint_coulomb");
    const auto before = laws.problem.evaluator.simulated();
    laws.decide();
    EXPECT_EQ(laws.id(0), "joint_coulomb");
    return laws.problem.evaluator.simulated() - before;
  };
  EXPECT_LT(simulated(2.5), simulated(1.2));
}

/// Dry friction of the shoulder is what is missing. Where the shoulder's damping has gone astray,
/// dry friction of the elbow says more.
double hides_friction_of_the_shoulder(const RobotModel& model) {
  const JointFrictionModel shoulder = MadeExperiment::friction_of(model, "shoulder"),
                           elbow = MadeExperiment::friction_of(model, "elbow");
  const double there = std::min(1.0, shoulder.kinetic_torque / 0.1),
               elsewhere = std::min(1.0, elbow.kinetic_torque / 0.1);
  if (shoulder.viscous < 0.4) return 50.0 * std::abs(shoulder.viscous - 0.15) + 6.0 - 6.0 * there;
  return 50.0 * std::abs(shoulder.viscous - 0.7) + 6.0 - 3.0 * there - 4.0 * elsewhere;
}

TEST(FinalComparison, TheSameLawElsewhereIsFirstIfItIsBetterInTheEnd) {
  const auto made = [](std::uint64_t seed) {
    return std::make_shared<MadeExperiment>(MadeExperiment::OfModel(hides_friction_of_the_shoulder),
                                            MadeExperiment::OfModel(hides_friction_of_the_shoulder),
                                            ElbowProblem::kBins, seed);
  };
  const MadeProblem problem(
      {{"joints.shoulder.friction.viscous", "Nms/rad", 0.15, 0.0, 1.0, 0.01}}, made(1), made(2),
      {"joint_coulomb", "force_sensor_gain", "force_sensor_offset"}, MadeExperiment::kCoarse);
  const Tested base = problem.hypotheses.tested(
      problem.train.start(Variant{{0.7}}, nuisance_unknowns(problem.evaluator)));
  ShortList list;
  for (const char* place : {"elbow", "shoulder"}) {
    Score score;
    score.candidate = problem.index(place, "joint_coulomb");
    score.gain = score.uncertainty = 1.0;
    score.amount = {1.0};
    list.entries.push_back(problem.comparison.weigh(base, {score}).entries.at(0));
  }
  problem.comparison.judge(base, list);
  const auto first = [&] { return problem.candidates[list.entries[0].candidate].place; };
  ASSERT_EQ(first(), "elbow");
  ASSERT_GT(list.entries[0].probability, 0.99);
  Gaps gaps(problem.train_judge, problem.test_judge, problem.candidates.size());
  gaps.begin(base.test);
  FinalComparison(problem.hypotheses, gaps).decide(base, list);
  EXPECT_EQ(first(), "shoulder");
  EXPECT_GT(list.entries[0].probability, 0.98);
  EXPECT_LT(list.entries[1].probability, 0.01);
  EXPECT_LT(list.entries[0].fit.cost, ElbowProblem::kBins);
}

TEST(FinalComparison, WhatIsNoBetterThanFitsScatterStaysOpen) {
  // Of a gap of 6 damping leaves 0.35: 0.3 % of what it gains, of which every block is sure.
  TwoLaws laws(
      [](double elbow, double shoulder, double dry) {
        const double damped = std::min(1.0, (elbow - kElbow) / kCatalogueDose);
        return 6.0 - 6.0 * std::max(std::min(1.0, dry / 0.1), 0.942 * damped) +
               50.0 * std::abs(shoulder - 0.15);
      },
      0.15);
  ASSERT_EQ(laws.id(0), "joint_coulomb");
  ASSERT_GT(laws.list.entries[0].probability, 0.99);
  laws.decide();
  EXPECT_EQ(laws.id(0), "joint_coulomb");
  EXPECT_NEAR(laws.list.entries[0].probability, 0.63, 0.05);
  EXPECT_NEAR(laws.list.entries[1].probability, 0.37, 0.05);
}

TEST(Scatter, OnlyLeadsBeyondItDecide) {
  const ElbowProblem problem([](double, double, double) { return 0.0; });
  const Tested base = problem.base(0.15);
  const auto with_cost = [&](double cost) {
    Tested tested = base;
    tested.fit.cost = cost;
    return tested;
  };
  const Tested far = with_cost(base.fit.cost + 1e5), end = base;
  const auto sure = [&](double by_blocks, double lead) {
    return allowing_for_scatter(by_blocks, problem.convergence, far, end,
                                with_cost(end.fit.cost + lead), 0.01);
  };
  const auto sure_of_other = [&](double by_blocks, double lead) {
    return allowing_for_scatter(by_blocks, problem.convergence, far, with_cost(end.fit.cost + lead),
                                end, 0.01);
  };
  // 1 % of the gain: 1000 nat.
  EXPECT_NEAR(sure(0.999, 1000.0), 0.841, 1e-3);
  EXPECT_NEAR(sure_of_other(0.001, 1000.0), 0.159, 1e-3);
  EXPECT_NEAR(sure(0.999, 0.0), 0.5, 1e-9);
  EXPECT_EQ(sure(0.999, 4000.0), 0.999);
  EXPECT_EQ(sure_of_other(0.001, 4000.0), 0.001);
  EXPECT_EQ(sure(0.6, 1000.0), 0.6);  // what the blocks leave open stays open
  EXPECT_EQ(sure_of_other(0.4, 1000.0), 0.4);
  // Blocks and sums may disagree: then neither is sure.
  EXPECT_EQ(sure_of_other(0.9, 1000.0), 0.5);
  EXPECT_EQ(sure(0.1, 1000.0), 0.5);
}

TEST(FinalComparison, WhatIsLeftFarBehindIsLost) {
  // Dry friction leaves 4 there and damping 4.5: half of the square and more. In the end it is 0.
  TwoLaws laws(hides_dry_friction(2.0, 1.5), 0.7);
  ASSERT_EQ(laws.id(0), "joint_coulomb");
  laws.list.entries[0].probability = 0.6;
  laws.list.entries[1].probability = 0.3;
  const double rough = laws.list.entries[1].fit.cost;
  laws.decide();
  EXPECT_EQ(laws.id(0), "joint_coulomb");
  EXPECT_NEAR(laws.list.entries[0].probability, 0.9, 1e-9);
  EXPECT_EQ(laws.list.entries[1].probability, 0.0);
  EXPECT_EQ(laws.list.entries[1].fit.cost, rough) << "not fitted to the end";
}

TEST(FinalComparison, WhatDidNotTakePartKeepsItsProbability) {
  // Fits of the two, told to be of a law of one size and of one of two sizes at another muscle. At
  // the first one's muscle that law does not challenge; it is no less likely for losing elsewhere.
  for (const double elsewhere : {0.25, 0.1}) {
    TwoLaws laws(hides_dry_friction(5.0, 4.0), 0.7);
    ASSERT_EQ(laws.id(0), "joint_coulomb");
    std::vector<FittedCandidate>& named = laws.list.entries;
    named[0].candidate = laws.problem.index("biceps_brachii", "force_sensor_gain");
    named[0].probability = 0.6;
    named[1].probability = elsewhere;
    named.push_back(named[1]);
    named[1].candidate = laws.problem.index("brachialis", "force_sensor_offset");
    const std::size_t here = laws.problem.index("biceps_brachii", "force_sensor_offset");
    named[2].candidate = here;
    named[2].probability = 0.2;
    if (elsewhere < 0.2) std::swap(named[1], named[2]);
    laws.decide();
    EXPECT_NEAR(named[0].probability, 0.6 + elsewhere, 1e-6);
    EXPECT_EQ(named[1].candidate, here);
    EXPECT_NEAR(named[1].probability, 0.2, 1e-9);
    EXPECT_NEAR(named[2].probability, 0.0, 1e-6);
  }
}

TEST(Screening, ExpectationsCountTheLessTheMoreWasRecorded) {
  // The shoulder's damping imitates the elbow's, as far as it is not expected to stay.
  const ElbowProblem::Law law = [](double elbow, double shoulder, double) {
    return (elbow - kElbow) / kCatalogueDose + 0.35 * (shoulder - 0.15);
  };
  const ElbowProblem problem(law);
  Fitted base = problem.fitted(0.15);
  problem.train.polish(base, 0);
  const auto uncertainty = [&](Eigen::Index bins) {
    Excerpt part{{std::make_shared<MadeExperiment>(law, law, bins, 1)}, {}};
    for (Eigen::Index b = 0; b < bins; ++b) part.rows.push_back(b);
    const Screening screening(problem.train, base, problem.candidates, part, part, {});
    for (const Score& score : screening.scores(base)) {
      if (score.candidate == problem.index("elbow")) return score.uncertainty;
    }
    return 0.0;
  };
  const double whole = uncertainty(ElbowProblem::kBins),
               half = uncertainty(ElbowProblem::kBins / 2);
  EXPECT_GT(whole, 3.0 / std::sqrt(ElbowProblem::kBins)) << "much of it is imitated";
  EXPECT_NEAR(half, std::sqrt(2.0) * whole, 0.01 * whole);
}

/// The elbow is asked whether it is needed beside the shoulder.
std::optional<Tested> without_elbow(const ElbowProblem& problem, double elbow) {
  Gaps gaps(problem.train_judge, problem.test_judge, problem.candidates.size());
  const Tested none = problem.base(0.15);
  gaps.begin(none.test);
  const std::size_t first = problem.index("elbow"), second = problem.index("shoulder");
  const Tested both =
      problem.hypotheses.tested(problem.with(problem.with(none.fit, first, elbow), second, 0.3));
  return BackwardElimination(problem.hypotheses, gaps)
      .without(0, first, none.fit.cost - both.fit.cost, both);
}

TEST(BackwardElimination, WhatWasNamedInAnothersSteadGoes) {
  // The shoulder's damping is all that matters. The elbow once was taken for it.
  const ElbowProblem problem(
      [](double, double shoulder, double) { return 20.0 * (shoulder - 0.45); });
  const auto without = without_elbow(problem, 0.2);
  ASSERT_TRUE(without);
  ASSERT_EQ(without->fit.variant.effects.size(), 1u);
  EXPECT_EQ(without->fit.variant.effects[0].place, "shoulder");
  EXPECT_EQ(without->test.size(), ElbowProblem::kBins);
}

TEST(BackwardElimination, WhatIsNeededStays) {
  // Each has a part of its own: what one lacks the other cannot say.
  const ElbowProblem problem([](double elbow, double shoulder, double) {
    return std::abs(20.0 * (shoulder - 0.45)) + std::abs(20.0 * (elbow - kElbow - 0.2));
  });
  EXPECT_FALSE(without_elbow(problem, 0.2));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
