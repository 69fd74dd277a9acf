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

/// For loops that wait for simulated time to go on, when it ran once: it stands while a simulator
/// is paused, and for ever when the simulator is gone.
class ClockWatch {
 public:
  /// To be called with ros::Time::now() as often as one likes. Warns when time has stood for 3 s of
  /// wall time, then every 10 s.
  /// @throws std::runtime_error if it stands and no living node publishes /clock
  void look(const ros::Time& time);

 private:
  ros::Time last_;
  ros::SteadyTime next_;  ///< when to look who publishes; zero: not looked yet
};

/// @param patience how long, of wall time, somebody may take to publish
/// @return one line, what is wrong and what to do, if ROS time stands at zero; empty if it runs
std::string standing_clock(const ros::WallDuration& patience);

}  // namespace anthrob
