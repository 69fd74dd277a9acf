#pragma once

#include <ros/time.h>

#include <string>

namespace anthrob {

/// Where /use_sim_time is true ROS time stands at zero until somebody publishes /clock. A simulator
/// leaves that parameter on a master that outlives it, and what waits for time waits for ever.
///
/// For loops that wait: says so in the log.
class ClockWait {
 public:
  /// To be called as often as one likes while ros::Time::now() is zero. Warns after 3 s, then every
  /// 10 s, of wall time: throttled log macros go by ROS time, which stands.
  void look();

 private:
  ros::SteadyTime next_;  ///< when to warn; zero: not looked yet
};

/// @param patience how long, of wall time, somebody may take to publish
/// @return one line, what is wrong and what to do, if ROS time stands at zero; empty if it runs
std::string standing_clock(const ros::WallDuration& patience);

}  // namespace anthrob
