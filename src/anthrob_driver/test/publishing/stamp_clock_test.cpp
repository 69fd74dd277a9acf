#include "publishing/stamp_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace driver {
namespace {

constexpr double kApart = 17.0;  ///< of both clocks [s]

/// What has arrived of /clock: ticks of 2 ms, up to 6 ms late.
double heard(double robot_now) {
  const double late = 0.003 + 0.003 * std::sin(700.0 * robot_now);
  return kApart + 0.002 * std::floor((robot_now - late) / 0.002);
}

TEST(StampClock, GrowsWithTheDriversClockThoughTicksComeLate) {
  StampClock clock;
  double before = 0.0, ros_now = 0.0;
  int stood = 0;
  for (int i = 0; i < 5000; ++i) {
    const double robot_now = 1.0 + 0.001 * i, ros_before = ros_now;
    ros_now = std::max(ros_now, heard(robot_now));  // a later message says a later time
    if (ros_now == ros_before) ++stood;
    const double now = clock.now(ros_now, robot_now);
    if (i > 100) {
      EXPECT_NEAR(now - before, 0.001, 1e-9) << i;
      EXPECT_NEAR(now, kApart + robot_now, 0.003) << i;
    }
    before = now;
  }
  EXPECT_GT(stood, 100) << "the ticks alone would not do";
}

TEST(StampClock, FollowsTimeThatIsSetBack) {
  StampClock clock;
  EXPECT_DOUBLE_EQ(clock.now(100.0, 1.0), 100.0);
  EXPECT_DOUBLE_EQ(clock.now(3.0, 2.0), 3.0);
  EXPECT_DOUBLE_EQ(clock.now(3.0, 2.05), 3.05);
}

TEST(StampClock, StandsStillWhereTimeDoesAndGoesOnWithIt) {
  StampClock clock;
  double before = clock.now(100.0, 1.0);
  for (double robot_now = 1.0; robot_now < 5.0; robot_now += 0.01) {
    const double now = clock.now(100.0, robot_now);
    EXPECT_GE(now, before);
    EXPECT_LE(now, 100.1 + 1e-9);
    before = now;
  }
  for (int i = 1; i < 300; ++i) {
    const double now = clock.now(100.0 + 0.01 * i, 5.0 + 0.01 * i);
    EXPECT_GE(now, before);
    EXPECT_NEAR(now, 100.0 + 0.01 * i, i > 10 ? 1e-9 : 0.11);
    before = now;
  }
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
