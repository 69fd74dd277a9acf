#include "search/excluded_places.h"

#include <gtest/gtest.h>

#include "anthrob_sim/effects/catalogue.h"

namespace anthrob {
namespace discovery {
namespace {

const std::vector<Candidate>& candidates() {
  static const std::vector<Candidate> list = {
      {find_effect("see_hysteresis"), "teres_major", {}, {}},
      {find_effect("second_maxwell_arm"), "teres_major", {}, {}},
      {find_effect("eyelet_friction"), "teres_major/2", {}, {}},
      {find_effect("joint_coulomb"), "elbow", {}, {}},
      {find_effect("force_crosstalk"), "biceps_brachii/teres_major", {}, {}},
  };
  return list;
}

std::vector<std::size_t> searched(const ExcludedPlaces& excluded) {
  std::vector<Score> scores(candidates().size());
  for (std::size_t c = 0; c < scores.size(); ++c) scores[c].candidate = c;
  std::vector<std::size_t> places;
  for (const Score& score : excluded.filter(scores)) places.push_back(score.candidate);
  return places;
}

using Places = std::vector<std::size_t>;

TEST(ExcludedPlaces, HideOnlyTheMuscleOrJointOfAnAcceptedEffect) {
  ExcludedPlaces excluded(candidates());
  EXPECT_EQ(searched(excluded), (Places{0, 1, 2, 3, 4}));
  EXPECT_TRUE(excluded.exclude(1, {0}));
  EXPECT_EQ(searched(excluded), (Places{3, 4}));
  EXPECT_FALSE(excluded.exclude(1, {0}));  // once is enough
  EXPECT_TRUE(excluded.exclude(3, {0, 3}));
  EXPECT_EQ(searched(excluded), Places{4});
  excluded.clear();
  EXPECT_EQ(searched(excluded), (Places{0, 1, 2, 3, 4}));
}

TEST(ExcludedPlaces, AreThoseOfAcceptedEffectsOnly) {
  ExcludedPlaces excluded(candidates());
  EXPECT_FALSE(excluded.exclude(3, {}));
  EXPECT_FALSE(excluded.exclude(3, {0, 2}));
  EXPECT_EQ(searched(excluded), (Places{0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
