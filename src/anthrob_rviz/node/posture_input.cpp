#include "posture_input.h"

#include <algorithm>
#include <cmath>

#include "anthrob_ros/bounded_connection.h"

namespace anthrob {

PostureInput::PostureInput(ros::NodeHandle& nh, const Skeleton& skeleton)
    : skeleton_(skeleton), has_balls_(skeleton.has(JointKind::kBall)), posture_(skeleton.rest()) {
  const auto no_delay = ros::TransportHints().tcpNoDelay();
  subscribers_ = {
      subscribe_bounded<sensor_msgs::JointState>(
          nh, "joint_states", 1,
          [this](const auto& message, const std::string&) { hear_joints(message); }, {}, no_delay),
      subscribe_bounded<anthrob_msgs::SphericalJointStates>(
          nh, "spherical_joint_states", 1,
          [this](const auto& message, const std::string&) { hear_balls(message); }, {}, no_delay),
  };
}

void PostureInput::hear_joints(const sensor_msgs::JointState& message) {
  const std::size_t count = std::min(message.name.size(), message.position.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto link = skeleton_.child_of(message.name[i]);
    if (link && std::isfinite(message.position[i])) posture_[*link].q = message.position[i];
  }
  add(message.header.stamp, !has_balls_);
}

void PostureInput::hear_balls(const anthrob_msgs::SphericalJointStates& message) {
  const std::size_t count = std::min(message.name.size(), message.orientation.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto link = skeleton_.child_of(message.name[i]);
    const geometry_msgs::Quaternion& q = message.orientation[i];
    const Quat rotation(q.w, q.x, q.y, q.z);
    if (link && std::abs(rotation.norm() - 1.0) < 1e-3) {
      posture_[*link].rotation = rotation.normalized();
    }
  }
  add(message.header.stamp, has_balls_);
}

/// @param whole whether all joints are of that time: ball joints are published last
void PostureInput::add(const ros::Time& stamp, bool whole) {
  // What is measured elsewhere may come late; time that went back is seconds away.
  const double late = history_.empty() ? 0.0 : history_.newest_time() - stamp.toSec();
  const double time =
      late > 0.0 && late < PostureHistory::kLength ? history_.newest_time() : stamp.toSec();
  history_.add(time, posture_);
  if (whole && on_posture) on_posture();
}

}  // namespace anthrob
