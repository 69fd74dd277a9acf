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
  EXPECT_EQ(nearest_name("x", {"a", "b"}), std::nullopt);
  EXPECT_EQ(nearest_name("", {"a"}), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(100000, 'h'), kLinks), std::nullopt);
}

TEST(NearestName, FindsWhatBeginsSo) {
  const std::vector<std::string> muscles = {"biceps_brachii", "triceps_brachii", "triceps_longus"};
  EXPECT_EQ(nearest_name("biceps", muscles), "biceps_brachii");
  EXPECT_EQ(nearest_name("Bic", muscles), "biceps_brachii");
  EXPECT_EQ(nearest_name("triceps", muscles), std::nullopt);  // either
  EXPECT_EQ(nearest_name("bi", muscles), std::nullopt);
}

TEST(NearestName, EndsAMessage) {
  EXPECT_EQ(expected_names("forarm", kLinks), "; did you mean 'forearm'?");
  EXPECT_EQ(expected_names("pelvis", {"base", "hand"}), "; expected one of base, hand");
  EXPECT_EQ(expected_names("pelvis", {}), "; expected none");
}

TEST(NearestName, PrefersTheNearest) {
  EXPECT_EQ(nearest_name("elbow_flexo", {"elbow_extensor", "elbow_flexor", "elbow"}),
            "elbow_flexor");
}

}  // namespace
}  // namespace anthrob
