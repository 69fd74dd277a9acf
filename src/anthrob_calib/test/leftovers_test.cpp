#include "anthrob_calib/discovery/leftovers.h"

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

std::vector<std::size_t> looked_at(const Leftovers& leftovers) {
  std::vector<Score> scores(candidates().size());
  for (std::size_t c = 0; c < scores.size(); ++c) scores[c].candidate = c;
  std::vector<std::size_t> places;
  for (const Score& score : leftovers.besides(scores)) places.push_back(score.candidate);
  return places;
}

using Places = std::vector<std::size_t>;

TEST(Leftovers, OfAnAcceptedOneHideNothingElse) {
  Leftovers leftovers(candidates());
  EXPECT_EQ(looked_at(leftovers), (Places{0, 1, 2, 3, 4}));
  EXPECT_TRUE(leftovers.refused(1, {0}));
  EXPECT_EQ(looked_at(leftovers), (Places{3, 4}));
  EXPECT_FALSE(leftovers.refused(1, {0}));  // once is enough
  EXPECT_TRUE(leftovers.refused(3, {0, 3}));
  EXPECT_EQ(looked_at(leftovers), Places{4});
  leftovers.forget();
  EXPECT_EQ(looked_at(leftovers), (Places{0, 1, 2, 3, 4}));
}

TEST(Leftovers, AreOfAcceptedOnesOnly) {
  Leftovers leftovers(candidates());
  EXPECT_FALSE(leftovers.refused(3, {}));
  EXPECT_FALSE(leftovers.refused(3, {0, 2}));
  EXPECT_EQ(looked_at(leftovers), (Places{0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
