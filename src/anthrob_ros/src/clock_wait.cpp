#include "anthrob_ros/clock_wait.h"

#include <ros/console.h>

#include <stdexcept>

#include "anthrob_ros/single_backend.h"

namespace anthrob {

namespace {

const ros::WallDuration kFirst(3.0), kAgain(10.0);
const char* const kStands =
    "/use_sim_time is true and nobody has published /clock yet; start the simulator, or, to run "
    "without one: rosparam set /use_sim_time false, then restart this node";

}  // namespace

void ClockWait::look() {
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (next_.isZero()) next_ = now + kFirst;
  if (now < next_) return;
  next_ = now + kAgain;
  ROS_WARN_STREAM(
      "waiting for /clock: "
      << (living_publisher("/clock")
              ? "the simulator is paused at its start; call sim/step, or sim/pause with false"
              : kStands));
}

void ClockWatch::look(const ros::Time& time) {
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (next_.isZero() || time != last_) {
    last_ = time;
    next_ = now + kFirst;
  }
  if (now < next_) return;
  next_ = now + kAgain;
  if (!living_publisher("/clock")) {
    throw std::runtime_error(
        "simulated time stands still and nobody publishes /clock any more: has the simulator "
        "ended?");
  }
  ROS_WARN("simulated time stands still: the simulator is paused or held up");
}

std::string standing_clock(const ros::WallDuration& patience) {
  return ros::Time::waitForValid(patience) ? "" : kStands;
}

}  // namespace anthrob
