#include "anthrob_ros/ball_joint_publisher.h"

namespace anthrob {

sensor_msgs::MultiDOFJointState multi_dof_joint_states(
    const anthrob_msgs::SphericalJointStates& states) {
  sensor_msgs::MultiDOFJointState all;
  all.header = states.header;
  all.joint_names = states.name;
  for (const geometry_msgs::Quaternion& orientation : states.orientation) {
    all.transforms.emplace_back();
    all.transforms.back().rotation = orientation;
  }
  for (const geometry_msgs::Vector3& velocity : states.angular_velocity) {
    all.twist.emplace_back();
    all.twist.back().angular = velocity;
  }
  return all;
}

BallJointPublisher::BallJointPublisher(ros::NodeHandle& nh, const std::string& place,
                                       std::uint32_t queue)
    : spherical_(nh.advertise<anthrob_msgs::SphericalJointStates>(place + "spherical_joint_states",
                                                                  queue)),
      multi_dof_(
          nh.advertise<sensor_msgs::MultiDOFJointState>(place + "multi_dof_joint_states", queue)) {}

void BallJointPublisher::publish(const anthrob_msgs::SphericalJointStates& states) const {
  spherical_.publish(states);
  if (multi_dof_.getNumSubscribers() > 0) multi_dof_.publish(multi_dof_joint_states(states));
}

}  // namespace anthrob
