#include "touch/drag.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

TEST(Drag, BeginsWithoutAPull) {
  const Drag drag({0.0, 0.1, 0.0}, {1.0, 2.0, 3.0}, 5.0);
  EXPECT_EQ(drag.point_L(), Vec3(0.0, 0.1, 0.0));
  EXPECT_EQ(drag.mouse_W(), Vec3(1.0, 2.0, 3.0));
}

TEST(Drag, FollowsTheMouse) {
  Drag drag(Vec3::Zero(), Vec3::Zero(), 5.0);
  drag.move({0.0, 0.0, 1.0}, 5.1);
  drag.hear(5.2);
  EXPECT_EQ(drag.mouse_W(), Vec3(0.0, 0.0, 1.0));
}

TEST(Drag, IsAbandonedHalfASecondAfterTheLastWord) {
  Drag drag(Vec3::Zero(), Vec3::Zero(), 5.0);
  EXPECT_FALSE(drag.abandoned(5.5));
  EXPECT_TRUE(drag.abandoned(5.51));
  drag.hear(5.4);
  EXPECT_FALSE(drag.abandoned(5.9));
  drag.move(Vec3::UnitX(), 5.8);
  EXPECT_FALSE(drag.abandoned(6.3));
  EXPECT_TRUE(drag.abandoned(6.31));
}

}  // namespace
}  // namespace anthrob
