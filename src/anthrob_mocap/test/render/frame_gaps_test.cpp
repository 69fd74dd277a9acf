// Gaps of tf, across which the virtual cameras draw nothing.
#include "render/frame_gaps.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace mocap {
namespace {

TEST(FrameGaps, HoldWhatLiesBetweenStampsThatAreFarApart) {
  FrameGaps gaps{FrameGaps::Options()};
  for (int i = 0; i <= 100; ++i) gaps.add("humerus", 1.0 + 0.02 * i);
  for (int i = 0; i <= 100; ++i) gaps.add("humerus", 4.0 + 0.02 * i);
  for (const double t : {1.5, 2.999, 3.0, 4.0, 5.01}) EXPECT_FALSE(gaps.hold("humerus", t)) << t;
  for (const double t : {3.001, 3.5, 3.999}) EXPECT_TRUE(gaps.hold("humerus", t)) << t;
  EXPECT_FALSE(gaps.hold("base", 3.5));  // static
}

TEST(FrameGaps, AreNoneWhereAFewStampsAreLost) {
  FrameGaps gaps{FrameGaps::Options()};
  for (int i = 0; i <= 100; ++i) {
    if (i < 50 || i > 52) gaps.add("humerus", 0.02 * i);
  }
  for (int i = 0; i < 200; ++i) EXPECT_FALSE(gaps.hold("humerus", 0.01 * i)) << i;
}

TEST(FrameGaps, AreForgottenWhenTimeStartsOver) {
  FrameGaps gaps{FrameGaps::Options()};
  gaps.add("humerus", 100.0), gaps.add("humerus", 101.0);
  EXPECT_TRUE(gaps.hold("humerus", 100.5));
  gaps.add("humerus", 50.0), gaps.add("humerus", 50.05);
  EXPECT_FALSE(gaps.hold("humerus", 100.5));
  EXPECT_FALSE(gaps.hold("humerus", 50.02));
}

TEST(FrameGaps, AreKeptAsLongAsTfKeepsTransforms) {
  FrameGaps gaps{FrameGaps::Options()};
  gaps.add("humerus", 1.0);
  for (int i = 0; i <= 1200; ++i) {
    gaps.add("humerus", 2.0 + 0.01 * i);
    EXPECT_EQ(gaps.hold("humerus", 1.5), i <= 1000) << i;
  }
}

}  // namespace
}  // namespace mocap
}  // namespace anthrob
