// The name that a misspelt one stands for.
#include "anthrob_core/nearest_name.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

const std::vector<std::string> kLinks = {"base", "upper_arm", "forearm", "hand"};

TEST(NearestName, FindsSlipsOfThePen) {
  EXPECT_EQ(nearest_name("forarm", kLinks), "forearm");    // a letter too few
  EXPECT_EQ(nearest_name("foreaarm", kLinks), "forearm");  // one too many
  EXPECT_EQ(nearest_name("foreatm", kLinks), "forearm");   // another one
  EXPECT_EQ(nearest_name("foraerm", kLinks), "forearm");   // two swapped
  EXPECT_EQ(nearest_name("UpperArm", kLinks), "upper_arm");
  EXPECT_EQ(nearest_name("xzy", {"xyz", "rpy"}), "xyz");
}

TEST(NearestName, IsNoneForAnotherWord) {
  EXPECT_EQ(nearest_name("pelvis", kLinks), std::nullopt);
  EXPECT_EQ(nearest_name("quat_xyzw", {"xyz", "rpy"}), std::nullopt);
  EXPECT_EQ(nearest_name("hand", {}), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(100000, 'h'), kLinks), std::nullopt);
}

TEST(NearestName, PrefersTheNearest) {
  EXPECT_EQ(nearest_name("elbow_flexo", {"elbow_extensor", "elbow_flexor", "elbow"}),
            "elbow_flexor");
}

}  // namespace
}  // namespace anthrob
