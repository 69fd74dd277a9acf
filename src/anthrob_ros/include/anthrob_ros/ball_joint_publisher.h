#pragma once

#include <anthrob_msgs/SphericalJointStates.h>
#include <ros/ros.h>
#include <sensor_msgs/MultiDOFJointState.h>

#include <cstdint>
#include <string>

namespace anthrob {

/// The same in ROS's own message, for programs that know nothing of ours: rotations without
/// translations, twists without linear parts, in the child's axes. Wrenches are not known.
sensor_msgs::MultiDOFJointState multi_dof_joint_states(
    const anthrob_msgs::SphericalJointStates& states);

/// Publishes ball joints as spherical_joint_states, and as multi_dof_joint_states if somebody
/// listens to that.
class BallJointPublisher {
 public:
  BallJointPublisher() = default;
  /// @param place of the topics in the handle's namespace: "" or "sim/"
  BallJointPublisher(ros::NodeHandle& nh, const std::string& place, std::uint32_t queue);

  void publish(const anthrob_msgs::SphericalJointStates& states) const;
  bool heard() const { return spherical_.getNumSubscribers() + multi_dof_.getNumSubscribers() > 0; }
  std::string topic() const { return spherical_.getTopic(); }

 private:
  ros::Publisher spherical_, multi_dof_;
};

}  // namespace anthrob
