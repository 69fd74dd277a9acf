#include "conclusion/verdict.h"

#include <gtest/gtest.h>

#include "anthrob_sim/effects/catalogue.h"
#include "diagnosis/location.h"
#include "search/named_effect.h"

namespace anthrob {
namespace discovery {
namespace {

Answer named(double probability, double remaining_share) {
  Answer answer;
  FoundEffect effect;
  effect.probability = probability;
  answer.effects = {effect};
  answer.remaining.share = remaining_share;
  return answer;
}

/// As conclude() does it. @param left gaps of the training recordings [floors]
void judge(const std::map<std::string, double>& left, bool certain, Answer& answer) {
  Diagnosis& diagnosis = answer.diagnosis;
  diagnosis.learned = left;
  diagnosis.certain = certain;
  diagnosis.remaining_share = answer.remaining.share;
  diagnosis.remaining = answer.remaining.dependences;
  answer.verdict = verdict_on(!answer.effects.empty(), diagnosis, {});
  for (FoundEffect& effect : answer.effects) effect = trusted(effect, {});
  answer.remaining = remaining_of(diagnosis, {});
}

Dependence dependence(const std::string& channel, const std::string& word, double share) {
  Dependence d;
  d.channel = channel;
  d.variable = "elbow/position";
  d.word = word;
  d.share = share;
  return d;
}

TEST(Verdict, WithoutANameItIsTheGapThatDecides) {
  Answer clean, gap;
  judge({{"elbow/position", 1.3}}, false, clean);
  EXPECT_EQ(clean.verdict, Verdict::kNoMissingEffect);
  judge({{"elbow/position", 2.3}}, true, gap);
  EXPECT_EQ(gap.verdict, Verdict::kUnexplained);
}

TEST(Verdict, AGapOnOneSideOnlyIsNotCalledNothing) {
  Answer answer;
  answer.diagnosis.one_sided = {{"elbow/position", 0.8, 27.0}};
  judge({{"elbow/position", 0.8}}, false, answer);
  EXPECT_EQ(answer.verdict, Verdict::kUnexplained);
  EXPECT_EQ(answer.remaining.description,
            "elbow/position differs between the fitted and the held-out recordings");
  Answer found = named(0.9, 0.0);
  found.diagnosis.one_sided = answer.diagnosis.one_sided;
  judge({{"elbow/position", 0.8}}, false, found);
  EXPECT_EQ(found.verdict, Verdict::kEffectsFound);
}

TEST(Verdict, ALawThatLeavesMuchOfWhatItWasToExplainIsLessLikely) {
  Answer answer = named(0.9, 0.0);
  answer.effects.push_back(answer.effects[0]);
  answer.effects[1].left = 0.05;  // the first leaves nothing
  for (FoundEffect& effect : answer.effects) {
    effect.rivals.push_back({"gear_efficiency", "Gear efficiency", "biceps_brachii", 0.2});
  }
  answer.search.alternatives.emplace_back().probability = 0.5;  // against the two
  answer.search.alternatives[0].instead_of[0] = 1;
  judge({{"elbow/position", 1.2}}, false, answer);
  EXPECT_DOUBLE_EQ(answer.effects[0].probability, 0.9);
  EXPECT_DOUBLE_EQ(answer.effects[0].rivals[0].probability, 0.2);
  EXPECT_DOUBLE_EQ(answer.effects[1].probability, 0.45);
  EXPECT_DOUBLE_EQ(answer.effects[1].rivals[0].probability, 0.1);
  EXPECT_DOUBLE_EQ(answer.search.alternatives[0].probability, 0.5);
  Answer nothing = named(0.9, 0.0);
  nothing.effects[0].left = 1.0;
  judge({{"elbow/position", 1.2}}, false, nothing);
  EXPECT_LT(nothing.effects[0].probability, 0.05);
}

TEST(Verdict, ALawThatEndsAtTheLimitOfItsShapeIsUnlikely) {
  Answer answer = named(0.9, 0.0);
  answer.effects[0].at_limit = "offset_u";
  answer.effects[0].left = 0.05;
  judge({{"elbow/position", 1.2}}, false, answer);
  EXPECT_DOUBLE_EQ(answer.effects[0].probability, 0.9 * 0.5 * 0.05);
}

TEST(Verdict, ALawThatSpoilsChannelsIsUnlikelyAsFarAsItExplainsLittle) {
  Answer answer = named(0.9, 0.0);
  answer.effects[0].spoilt = 0.02;
  EXPECT_DOUBLE_EQ(trust_in(answer.effects[0], {}, false), 0.5);
  answer.effects[0].spoilt = 0.18;
  EXPECT_DOUBLE_EQ(trust_in(answer.effects[0], {}, false), 0.1);
  answer.effects[0].left = 0.05;
  judge({{"elbow/position", 1.2}}, false, answer);
  EXPECT_DOUBLE_EQ(answer.effects[0].probability, 0.9 * 0.5 * 0.1);
}

TEST(LimitOf, IsAFittedShapeThatCouldHaveGoneEitherWay) {
  Candidate surface{find_effect("wrapping_surface"), "brachialis/2", {}, {}};
  surface.parameters = surface.effect->info().parameters;
  EffectInstance instance = surface.dose(*surface.sizes().front());
  EXPECT_EQ(limit_of(surface, instance, {}), std::nullopt);
  instance.parameters["offset_u"] = -0.0478;
  EXPECT_EQ(limit_of(surface, instance, {}), "offset_u");
  instance.parameters["offset_u"] = -0.0465;
  EXPECT_EQ(limit_of(surface, instance, {}), std::nullopt);
  // Sizes that the range cuts off are larger than was thought; shapes that begin at an end are
  // none.
  Candidate friction{find_effect("joint_coulomb"), "elbow", {}, {}};
  friction.parameters = friction.effect->info().parameters;
  instance = friction.neutral();
  instance.parameters["static_ratio"] = 1.0;
  EXPECT_EQ(limit_of(friction, instance, {}), std::nullopt);
  Candidate offset{find_effect("force_sensor_offset"), "brachialis", {}, {}};
  offset.parameters = offset.effect->info().parameters;
  instance = offset.neutral();
  instance.parameters["offset"] = 50.0;
  EXPECT_EQ(limit_of(offset, instance, {}), std::nullopt);
}

TEST(Verdict, NamesThatLeaveMostOfTheGapAreNoAnswer) {
  for (const double share : {0.44, 0.46}) {
    Answer answer = named(0.9, share);
    judge({{"elbow/position", 2.0}}, true, answer);
    EXPECT_EQ(answer.verdict, share < 0.45 ? Verdict::kEffectsFound : Verdict::kUnexplained);
    // It may be right, and something else missing elsewhere.
    EXPECT_DOUBLE_EQ(answer.effects[0].probability, 0.9);
  }
}

TEST(Verdict, WhatChanceMayLeaveSpeaksAgainstNoName) {
  Answer answer = named(0.9, 0.75);
  judge({{"elbow/position", 1.2}}, false, answer);
  EXPECT_EQ(answer.verdict, Verdict::kEffectsFound);
  EXPECT_DOUBLE_EQ(answer.effects[0].probability, 0.9);
  EXPECT_EQ(answer.remaining.description, "no certain gap");
}

TEST(Verdict, NamesWhatMostOfTheRestDependsOn) {
  Answer answer;
  answer.remaining.dependences = {dependence("elbow/position", "load", 0.9),
                                  dependence("biceps_brachii/force", "sign of velocity", 0.5)};
  judge({{"elbow/position", 1.5}, {"biceps_brachii/force", 4.0}}, true, answer);
  EXPECT_EQ(answer.remaining.description,
            "biceps_brachii/force depends on sign of velocity of elbow/position");
  EXPECT_EQ(answer.remaining.dependences[0].channel,
            "biceps_brachii/force");  // the first to be shown
  answer.remaining.dependences = {dependence("biceps_brachii/force", "load", 0.04)};
  judge({{"elbow/position", 1.5}, {"biceps_brachii/force", 4.0}}, true, answer);
  EXPECT_EQ(answer.remaining.description, "a gap that depends on none of the measured quantities");
}

TEST(Verdict, AnOffsetDependsOnNothing) {
  Answer answer;
  answer.remaining.dependences = {dependence("elbow/position", "time", 0.06)};
  answer.remaining.dependences[0].constant = 0.7;
  judge({{"elbow/position", 3.0}}, true, answer);
  EXPECT_EQ(answer.remaining.description, "elbow/position is off by a constant");
}

TEST(Regime, OfAConstantToldApartFromWhatElseAGapDependsOn) {
  std::vector<Dependence> gap = {dependence("biceps_brachii/force", "load", 0.9),
                                 dependence("elbow/position", "posture", 0.3)};
  EXPECT_EQ(regime_of("elbow/position", gap, 0.05), "posture of elbow/position");
  gap[1].constant = 0.2;
  EXPECT_EQ(regime_of("elbow/position", gap, 0.05), "posture of elbow/position");
  gap[1].constant = 0.6;
  EXPECT_EQ(regime_of("elbow/position", gap, 0.05),
            "mostly off by a constant; the rest: posture of elbow/position");
  gap[1].share = 0.04;
  EXPECT_EQ(regime_of("elbow/position", gap, 0.05), "nothing: off by a constant");
  gap[1].constant = 0.04;
  EXPECT_EQ(regime_of("elbow/position", gap, 0.05), "");
}

TEST(Verdict, TellsWhatTheRestDependsOn) {
  Answer answer;
  answer.remaining.dependences = {dependence("elbow/position", "load", 0.3),
                                  dependence("wrist/position", "sign of velocity", 0.2)};
  answer.remaining.dependences[1].second = Dependence::Second{"wrist/load", "N", "load", 0.6, {}};
  judge({{"elbow/position", 3.0}, {"wrist/position", 3.0}}, true, answer);
  EXPECT_EQ(answer.remaining.description,
            "wrist/position depends on sign of velocity of elbow/position and load of wrist/load");
}

TEST(Verdict, NothingIsToldOfChannelsThatAreNoHigherThanNoise) {
  const std::vector<Dependence> found = {dependence("elbow/position", "load", 0.9),
                                         dependence("biceps_brachii/force", "load", 0.5)};
  Answer answer;
  answer.remaining.dependences = found;
  judge({{"elbow/position", 0.7}, {"biceps_brachii/force", 4.0}}, true, answer);
  ASSERT_EQ(answer.remaining.dependences.size(), 1u);
  EXPECT_EQ(answer.remaining.dependences[0].channel, "biceps_brachii/force");
  answer.remaining.dependences = found;
  judge({{"elbow/position", 1.5}, {"biceps_brachii/force", 1.5}}, false, answer);
  EXPECT_TRUE(answer.remaining.dependences.empty());
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
