#pragma once

#include <algorithm>

namespace anthrob {
namespace driver {

/// Simulated ROS time for stamps. /clock arrives in ticks, and each tick is late by the time that
/// its message took, so stamps taken from it directly could put measurements in the wrong order.
/// The driver's clock is smooth: this class adds to it the offset of the tick that was least late.
class StampClock {
 public:
  /// @param ros_now [s] what /clock said last   @param robot_now [s] of the driver's clock
  /// @return [s] ROS time now; goes back only where ROS time does, stands still where it does
  double now(double ros_now, double robot_now) {
    const bool fresh = ros_now > heard_, set_back = ros_now < heard_;
    if (!known_ || set_back || (stands_ && fresh)) apart_ = ros_now - robot_now;
    if (!known_ || set_back) last_ = ros_now;
    apart_ = std::max(apart_, ros_now - robot_now);
    if (fresh) stands_ = false;
    stands_ = stands_ || robot_now + apart_ > ros_now + kLatest;
    known_ = true;
    heard_ = ros_now;
    last_ = std::max(last_, stands_ ? ros_now + kLatest : robot_now + apart_);
    return last_;
  }

 private:
  /// [s] Assumed upper bound of a tick's delay.
  static constexpr double kLatest = 0.1;

  double apart_ = 0.0, heard_ = 0.0, last_ = 0.0;
  bool known_ = false, stands_ = false;
};

}  // namespace driver
}  // namespace anthrob
