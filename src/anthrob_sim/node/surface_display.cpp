#include "surface_display.h"

#include "anthrob_sim/conversions.h"

namespace anthrob {

namespace {

constexpr double kPeriod = 5.0;  // [s] of wall time

}  // namespace

SurfaceDisplay::SurfaceDisplay(ros::NodeHandle& nh, const RobotModel& model)
    : surfaces_(surface_markers(model)),
      publisher_(nh.advertise<visualization_msgs::MarkerArray>("wrapping_surfaces", 1, true)) {
  publisher_.publish(surfaces_);
  timer_ = nh.createWallTimer(ros::WallDuration(kPeriod), [this](const ros::WallTimerEvent&) {
    if (publisher_.getNumSubscribers() > 0) publisher_.publish(surfaces_);
  });
}

}  // namespace anthrob
