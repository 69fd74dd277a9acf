#pragma once

#include <anthrob_msgs/CalibrateAction.h>
#include <anthrob_msgs/DiscoverAction.h>
#include <ros/ros.h>

#include "job_server.h"

namespace anthrob {

/// The actions `calibrate` and `discover`: each runs its program as a child process, one at a time.
/// They command no robot. Programs end with the thread that serves the callbacks (ChildProcess), so
/// that must be one that lives as long as the node: ros::spin().
class JobServers {
 public:
  /// @param nh of the robot's namespace
  explicit JobServers(const ros::NodeHandle& nh);

 private:
  JobServer<anthrob_msgs::CalibrateAction> calibrate_;
  JobServer<anthrob_msgs::DiscoverAction> discover_;
};

}  // namespace anthrob
