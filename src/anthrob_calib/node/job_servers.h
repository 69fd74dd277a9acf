#pragma once

#include <anthrob_msgs/CalibrateAction.h>
#include <anthrob_msgs/DiscoverAction.h>
#include <anthrob_msgs/HealthTestAction.h>
#include <ros/ros.h>

#include "job_server.h"

namespace anthrob {

/// The actions `calibrate`, `discover` and `health/test`: each runs its program as a child process,
/// one at a time. Only the last one commands the robot. Programs end with the thread that serves
/// the callbacks (ChildProcess), so that must be one that lives as long as the node: ros::spin().
class JobServers {
 public:
  /// @param nh of the robot's namespace
  /// @param usual what a goal of health/test leaves out
  JobServers(const ros::NodeHandle& nh, const jobs::HealthOrder& usual);

 private:
  JobServer<anthrob_msgs::CalibrateAction> calibrate_;
  JobServer<anthrob_msgs::DiscoverAction> discover_;
  JobServer<anthrob_msgs::HealthTestAction> health_;
};

}  // namespace anthrob
