#include "search/named_law.h"

#include <gtest/gtest.h>

#include "anthrob_sim/effects/catalogue.h"
#include "separation/separating_experiment.h"

namespace anthrob {
namespace discovery {
namespace {

const std::vector<Candidate>& law_candidates() {
  static const std::vector<Candidate> list = {
      {find_effect("joint_coulomb"), "elbow", {}, {}},
      {find_effect("joint_coulomb_asymmetric"), "elbow", {}, {}},
      {find_effect("cable_drag"), "elbow", {}, {}},
      {find_effect("payload"), "forearm", {}, {}},
  };
  return list;
}

/// Dry friction, with what says more and others as rivals.
NamedLaw friction() {
  ShortList list;
  list.entries.resize(4);
  const double probabilities[] = {0.6, 0.2, 0.1, 0.01};
  for (std::size_t i = 0; i < 4; ++i) {
    list.entries[i].candidate = i;
    list.entries[i].probability = probabilities[i];
    list.entries[i].evidence = 100.0 - static_cast<double>(i);
  }
  return named_law(list, law_candidates(), 0.02);
}

TEST(FoundEffect, HasTheOthersForRivals) {
  const NamedLaw effect = friction();
  EXPECT_EQ(effect.id, "joint_coulomb");
  EXPECT_EQ(effect.place, "elbow");
  ASSERT_EQ(effect.rivals.size(), 2u);  // 0.01 is not worth telling
  EXPECT_EQ(effect.rivals[0].id, "joint_coulomb_asymmetric");
  EXPECT_EQ(effect.rivals[1].id, "cable_drag");
}

TEST(FoundEffect, WhatSaysMoreTakesItsOwnProbabilityAlong) {
  NamedLaw effect = friction();
  const Replaced replaced = name_instead(law_candidates()[1], {0.75, 12.0}, effect, 0.02);
  EXPECT_TRUE(replaced.is_first_rival);
  effect = replaced.effect;
  EXPECT_EQ(effect.id, "joint_coulomb_asymmetric");
  EXPECT_EQ(how_to_separate(effect),
            separating_experiment("joint_coulomb_asymmetric", "joint_coulomb"));
  EXPECT_DOUBLE_EQ(effect.probability, 0.75 * 0.8);
  EXPECT_DOUBLE_EQ(effect.evidence, 112.0);
  ASSERT_EQ(effect.rivals.size(), 2u);
  EXPECT_EQ(effect.rivals[0].id, "joint_coulomb");
  EXPECT_DOUBLE_EQ(effect.rivals[0].probability, 0.25 * 0.8);
  EXPECT_EQ(effect.rivals[1].id, "cable_drag");
}

TEST(FoundEffect, WhatIsExcludedIsNoRival) {
  NamedLaw effect = friction();
  Replaced replaced = name_instead(law_candidates()[1], {0.999, 50.0}, effect, 0.02);
  EXPECT_FALSE(replaced.is_first_rival);
  effect = replaced.effect;
  ASSERT_EQ(effect.rivals.size(), 1u);
  EXPECT_EQ(effect.rivals[0].id, "cable_drag");
  EXPECT_EQ(how_to_separate(effect),
            separating_experiment("joint_coulomb_asymmetric", "cable_drag"));
  effect.rivals.clear();
  effect = name_instead(law_candidates()[1], {0.999, 50.0}, effect, 0.02).effect;
  EXPECT_EQ(how_to_separate(effect), "");
}

TEST(FoundEffect, OfTwoThatDoAsWellEachHasHalf) {
  NamedLaw effect = friction();
  effect = leave_open(law_candidates()[1], {0.7, 5.0}, effect);
  EXPECT_EQ(effect.id, "joint_coulomb");
  EXPECT_DOUBLE_EQ(effect.probability, 0.4);
  ASSERT_EQ(effect.rivals.size(), 2u);
  EXPECT_EQ(effect.rivals[0].id, "joint_coulomb_asymmetric");
  EXPECT_DOUBLE_EQ(effect.rivals[0].probability, 0.4);
  EXPECT_DOUBLE_EQ(effect.rivals[0].evidence, 105.0);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
