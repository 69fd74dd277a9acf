#include "touch/goal_posture.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

const char* const kGantry = R"(<robot name="gantry">
  <link name="wall"/><link name="car"/><link name="arm"/><link name="head"/>
  <joint name="rail" type="prismatic"><parent link="wall"/><child link="car"/>
    <origin xyz="0 0 1" rpy="0 0 1.5707963267948966"/><axis xyz="1 0 0"/>
    <limit lower="-0.1" upper="0.3" effort="0" velocity="0"/></joint>
  <joint name="crank" type="revolute"><parent link="car"/><child link="arm"/>
    <origin xyz="0.1 0 0"/><axis xyz="0 0 -1"/>
    <limit lower="-1" upper="4" effort="0" velocity="0"/></joint>
  <joint name="neck" type="floating"><parent link="arm"/><child link="head"/>
    <origin xyz="0 0.2 0"/></joint></robot>)";

class GoalPostures : public testing::Test {
 protected:
  const LinkJoint& joint(std::size_t link) { return gantry_.links()[link].joint; }
  /// What is asked for where the joint is.
  AskedPosition there_and_back(std::size_t link, const JointPosition& position,
                               const JointPosition& near) {
    return position_for(joint(link), pose_of(joint(link), position), near);
  }

  Skeleton gantry_{kGantry, {{"neck", Vec3(0.0, 0.05, 0.0)}}};
  GoalPosture goal_{gantry_};
};

TEST_F(GoalPostures, APoseGivesThePositionThatHasIt) {
  EXPECT_NEAR(there_and_back(1, {0.2}, {}).position.q, 0.2, 1e-12);
  EXPECT_NEAR(there_and_back(2, {-0.7}, {}).position.q, -0.7, 1e-12);
  // Beyond half a turn it counts from where the hinge was.
  EXPECT_NEAR(there_and_back(2, {3.5}, {3.0}).position.q, 3.5, 1e-12);
  const Quat turned(Eigen::AngleAxisd(1.2, Vec3(0.0, 0.6, 0.8)));
  EXPECT_LT(angular_distance(there_and_back(3, {0.0, turned}, {}).position.rotation, turned), 1e-7);
}

TEST_F(GoalPostures, AJointIsAskedToItsStopsAtMost) {
  EXPECT_FALSE(there_and_back(1, {0.3 - 1e-9}, {}).at_stop);
  const AskedPosition slide = there_and_back(1, {0.4}, {});
  EXPECT_EQ(slide.position.q, 0.3);
  EXPECT_TRUE(slide.at_stop);
  const AskedPosition hinge = there_and_back(2, {-1.5}, {});
  EXPECT_EQ(hinge.position.q, -1.0);
  EXPECT_TRUE(hinge.at_stop);
}

TEST_F(GoalPostures, JointsThatNobodyAskedForAreWhereTheyAreMeasured) {
  Posture measured = gantry_.rest();
  measured[1].q = 0.1;
  measured[2].q = 0.5;
  EXPECT_TRUE(goal_.empty());
  EXPECT_EQ(goal_.way(measured), 0.0);
  Posture wanted = measured;
  wanted[2].q = 1.5;
  goal_.ask(2, gantry_.pose(2, wanted), measured);
  EXPECT_FALSE(goal_.empty());
  EXPECT_NEAR(goal_.way(measured), 1.0, 1e-12);
  measured[1].q = 0.2;
  const Posture posture = goal_.posture(measured);
  EXPECT_EQ(posture[1].q, 0.2);
  EXPECT_NEAR(posture[2].q, 1.5, 1e-12);
  goal_.forget();
  EXPECT_TRUE(goal_.empty());
}

TEST_F(GoalPostures, AJointHangsOnWhatWasAskedBefore) {
  const Posture measured = gantry_.rest();
  Posture wanted = measured;
  wanted[1].q = 0.2;
  wanted[2].q = 0.8;
  wanted[3].rotation = Quat(Eigen::AngleAxisd(0.4, Vec3::UnitX()));
  for (const std::size_t link : {1u, 2u, 3u}) {
    goal_.ask(link, gantry_.pose(link, wanted), measured);
  }
  const Posture posture = goal_.posture(measured);
  for (std::size_t link = 0; link < 4; ++link) {
    EXPECT_NEAR((gantry_.pose(link, posture).p - gantry_.pose(link, wanted).p).norm(), 0.0, 1e-9);
  }
  EXPECT_NEAR(goal_.way(measured), 0.8, 1e-12);
}

}  // namespace
}  // namespace anthrob
