#include "muscle_groups.h"

#include <gtest/gtest.h>

#include <cmath>

namespace anthrob {
namespace {

using Names = std::vector<std::string>;

TEST(MuscleGroups, AntagonistsOfEachAxis) {
  const auto groups = groups_by_axis({"flexor", "extensor", "brace"}, {"elbow", "wrist", "free"},
                                     {0.02, 0.001, 0.0, -0.03, 0.0, 0.0, 0.001, -0.01, 0.0});
  ASSERT_EQ(groups.size(), 4U);
  EXPECT_EQ(groups[0].name, "elbow +");
  EXPECT_EQ(groups[0].muscles, Names{"flexor"});
  EXPECT_EQ(groups[1].name, "elbow -");
  EXPECT_EQ(groups[1].muscles, Names{"extensor"});
  EXPECT_EQ(groups[2].name, "wrist +");
  EXPECT_EQ(groups[2].muscles, Names{"flexor"});
  EXPECT_EQ(groups[3].name, "wrist -");
  EXPECT_TRUE(groups[3].has("brace"));
  EXPECT_FALSE(groups[3].has("flexor"));
}

TEST(MuscleGroups, OfAMessageThatDoesNotFitOrIsNoNumberThereAreNone) {
  EXPECT_TRUE(groups_by_axis({"flexor"}, {"elbow", "wrist"}, {0.02}).empty());
  EXPECT_TRUE(groups_by_axis({"flexor"}, {"elbow"}, {std::nan("")}).empty());
}

TEST(MuscleGroups, ByTheUnitsThatNameTheirMuscles) {
  Diagnostics diagnostics;
  diagnostics.hear({"/arm: ecu_1", Level::kOk, "", {{"flexor temperature", "25"}}}, 0.0);
  diagnostics.hear({"/arm: ecu_2", Level::kOk, "", {{"extensor temperature", "25"}}}, 0.0);
  diagnostics.hear({"/other: ecu_3", Level::kOk, "", {{"brace temperature", "25"}}}, 0.0);
  const auto groups = groups_by_unit(diagnostics, "/arm", {"flexor", "extensor", "brace"}, 0.0);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].name, "ecu_1");
  EXPECT_EQ(groups[1].muscles, Names{"extensor"});
}

}  // namespace
}  // namespace anthrob
