#include "anthrob_ros/ball_joint_publisher.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

TEST(MultiDofJointStates, AreTheBallJoints) {
  anthrob_msgs::SphericalJointStates states;
  states.header.stamp = ros::Time(3.5);
  states.header.frame_id = "world";
  states.name = {"shoulder", "hip"};
  states.orientation.resize(2);
  states.orientation[1].w = 0.8, states.orientation[1].y = 0.6;
  states.angular_velocity.resize(2);
  states.angular_velocity[1].z = -2.0;
  const sensor_msgs::MultiDOFJointState same = multi_dof_joint_states(states);
  EXPECT_EQ(same.header, states.header);
  EXPECT_EQ(same.joint_names, states.name);
  ASSERT_EQ(same.transforms.size(), 2u);
  EXPECT_EQ(same.transforms[1].rotation, states.orientation[1]);
  EXPECT_EQ(same.transforms[1].translation, geometry_msgs::Vector3());
  ASSERT_EQ(same.twist.size(), 2u);
  EXPECT_EQ(same.twist[1].angular, states.angular_velocity[1]);
  EXPECT_TRUE(same.wrench.empty());
}

}  // namespace
}  // namespace anthrob
