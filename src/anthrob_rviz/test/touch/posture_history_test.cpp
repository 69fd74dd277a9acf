#include "touch/posture_history.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

const char* const kRod = R"(<robot name="rod"><link name="base"/><link name="rod"/>
  <joint name="pivot" type="continuous"><parent link="base"/><child link="rod"/>
  <axis xyz="0 0 1"/></joint></robot>)";

Posture at_angle(const Skeleton& rod, double angle) {
  Posture posture = rod.rest();
  posture[1].q = angle;
  return posture;
}

class PostureHistories : public testing::Test {
 protected:
  void add(double time, double angle) { history_.add(time, at_angle(rod_, angle)); }
  double angle_at(double time) { return history_.at(time)[1].q; }

  Skeleton rod_{kRod, {}};
  PostureHistory history_;
};

TEST_F(PostureHistories, TellsWhatWasAtATime) {
  EXPECT_TRUE(history_.empty());
  for (const double t : {1.0, 1.1, 1.2}) add(t, t);
  EXPECT_EQ(angle_at(1.1), 1.1);
  EXPECT_EQ(angle_at(1.15), 1.1);
  EXPECT_EQ(angle_at(9.0), 1.2);
  EXPECT_EQ(angle_at(0.0), 1.0);
  EXPECT_EQ(history_.newest()[1].q, 1.2);
}

TEST_F(PostureHistories, ForgetsAfterASecondAndWhenTimeGoesBack) {
  for (int i = 0; i <= 200; ++i) add(0.01 * i, i);
  EXPECT_EQ(angle_at(0.0), 100);
  add(0.5, 7.0);
  EXPECT_EQ(history_.newest_time(), 0.5);
  EXPECT_EQ(angle_at(9.0), 7.0);
  add(0.5, 8.0);  // the other joints of the same time
  EXPECT_EQ(angle_at(9.0), 8.0);
}

TEST_F(PostureHistories, MeasuresTheVelocityOfAPoint) {
  const Vec3 tip(0.5, 0.0, 0.0);
  add(1.0, 0.0);
  EXPECT_EQ(history_.velocity(rod_, 1, tip), Vec3(Vec3::Zero()));
  for (int i = 1; i <= 10; ++i) add(1.0 + 0.002 * i, 0.002 * i * 3.0);  // 3 rad/s
  const Vec3 v = history_.velocity(rod_, 1, tip);
  EXPECT_NEAR(v.norm(), 1.5, 0.001);
  EXPECT_NEAR(v.y(), 1.5, 0.002);
}

}  // namespace
}  // namespace anthrob
