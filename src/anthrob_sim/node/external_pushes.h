#pragma once

#include <anthrob_msgs/ApplyWrench.h>
#include <ros/ros.h>

#include "anthrob_sim/simulation.h"

namespace anthrob {

/// The service sim/apply_wrench, and the topic external_wrenches that says what acts.
class ExternalPushes {
 public:
  /// @param sim must outlive it
  ExternalPushes(ros::NodeHandle& nh, Simulation& sim);

  /// With the state of the same time.
  void publish(const ros::Time& stamp);

 private:
  bool on_apply(anthrob_msgs::ApplyWrench::Request& request,
                anthrob_msgs::ApplyWrench::Response& response);

  Simulation& sim_;
  ros::Publisher publisher_;
  ros::ServiceServer service_;
  bool acted_ = false;  ///< at the last publication
};

}  // namespace anthrob
