#pragma once

namespace anthrob {
namespace driver {

/// Simulated ROS time, as it comes with /clock, for stamps: in ticks, and each tick late by as long
/// as its message took. Measurements stamped by it could come in the order of the messages instead
/// of their own. The driver's clock is smooth; what was least late tells how the two are apart.
class StampClock {
 public:
  /// @param ros_now [s] what /clock said last   @param robot_now [s] of the driver's clock
  /// @return [s] ROS time now; never goes back unless ROS time was set back
  double now(double ros_now, double robot_now) {
    const double apart = ros_now - robot_now;
    if (!known_ || apart > apart_ || apart < apart_ - kSetBack) apart_ = apart;
    known_ = true;
    return robot_now + apart_;
  }

 private:
  static constexpr double kSetBack = 0.5;  ///< [s]; no message is that late

  double apart_ = 0.0;
  bool known_ = false;
};

}  // namespace driver
}  // namespace anthrob
