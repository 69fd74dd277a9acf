#include "anthrob_control/ros/reference_watch.h"

#include <stdexcept>

namespace anthrob {

namespace {

constexpr double kPatience = 1.0;  // [s]

}  // namespace

void ReferenceWatch::look(const RobotState& state, const ros::Time& now, bool sure) {
  const std::optional<std::string> deaf = state.muscle_not_in(ecu::Mode::kPosition);
  const ros::WallTime wall = ros::WallTime::now();
  if (!deaf) {
    since_ = ros::Time();
    return;
  }
  if (since_.isZero() || now < since_) since_ = now, wall_since_ = wall;
  const bool long_enough = sure || (wall - wall_since_).toSec() > kPatience;
  if ((now - since_).toSec() > kPatience && long_enough) {
    throw std::runtime_error("the robot does not follow the references of " + *deaf +
                             ": last_rejection in /diagnostics says why; after power-up, call home "
                             "first");
  }
}

}  // namespace anthrob
