#include "anthrob_driver/stamp_clock.h"

#include <gtest/gtest.h>

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
  double before = 0.0, heard_before = 0.0;
  int back = 0;
  for (int i = 0; i < 5000; ++i) {
    const double robot_now = 1.0 + 0.001 * i, ros_now = clock.now(heard(robot_now), robot_now);
    if (heard(robot_now) <= heard_before) ++back;
    heard_before = heard(robot_now);
    if (i > 100) {
      EXPECT_NEAR(ros_now - before, 0.001, 1e-9) << i;
      EXPECT_NEAR(ros_now, kApart + robot_now, 0.003) << i;
    }
    before = ros_now;
  }
  EXPECT_GT(back, 100) << "the ticks alone would not do";
}

TEST(StampClock, FollowsTimeThatIsSetBack) {
  StampClock clock;
  EXPECT_DOUBLE_EQ(clock.now(100.0, 1.0), 100.0);
  EXPECT_DOUBLE_EQ(clock.now(3.0, 2.0), 3.0);
  EXPECT_DOUBLE_EQ(clock.now(3.9, 3.0), 4.0);
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
