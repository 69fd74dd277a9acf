#include "anthrob_ros/bounded_connection.h"

namespace anthrob {

void RefusalWarning::warn(const std::string& why) {
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (!last_.isZero() && now - last_ < ros::WallDuration(1.0)) return;
  last_ = now;
  ROS_WARN_STREAM(what_ << " refused: " << why);
}

}  // namespace anthrob
