#pragma once

#include <anthrob_msgs/SphericalJointStates.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include <functional>
#include <vector>

#include "touch/posture_history.h"

namespace anthrob {

/// The robot's joints as they are measured.
class PostureInput {
 public:
  /// @param skeleton must outlive it
  PostureInput(ros::NodeHandle& nh, const Skeleton& skeleton);

  const PostureHistory& history() const { return history_; }
  /// Called with every new posture.
  std::function<void()> on_posture;

 private:
  void hear_joints(const sensor_msgs::JointState& message);
  void hear_balls(const anthrob_msgs::SphericalJointStates& message);
  void add(const ros::Time& stamp, bool whole);

  const Skeleton& skeleton_;
  bool has_balls_;
  Posture posture_;
  PostureHistory history_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace anthrob
