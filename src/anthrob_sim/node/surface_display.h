#pragma once

#include <ros/ros.h>
#include <visualization_msgs/MarkerArray.h>

#include "anthrob_sim/model/robot_model.h"

namespace anthrob {

/// Shows the wrapping surfaces of a model in RViz: latched, and sent again every few seconds while
/// somebody listens. An RViz that does not yet know a marker's frame reports an error until it gets
/// the marker again.
class SurfaceDisplay {
 public:
  SurfaceDisplay(ros::NodeHandle& nh, const RobotModel& model);

 private:
  visualization_msgs::MarkerArray surfaces_;
  ros::Publisher publisher_;
  ros::WallTimer timer_;
};

}  // namespace anthrob
