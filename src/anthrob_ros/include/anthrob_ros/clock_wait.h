#pragma once

#include <ros/time.h>

#include <string>

namespace anthrob {

/// For loops that wait for ROS time to start: warns in the log.
///
/// While /use_sim_time is true, ROS time is zero until somebody publishes /clock. A simulator that
/// ends leaves the parameter true on the master, and later nodes then wait for ever.
class ClockWait {
 public:
  /// To be called as often as one likes while ros::Time::now() is zero. Warns after 3 s of wall
  /// time, then every 10 s. (Throttled log macros use ROS time, which stands still.)
  void look();

 private:
  ros::SteadyTime next_;  ///< when to warn; zero: not looked yet
};

/// For loops that wait for simulated time to advance after it has started. It stands still while
/// the simulator is paused, and for ever once the simulator has ended.
class ClockWatch {
 public:
  /// To be called with ros::Time::now() as often as one likes. Warns when time has not advanced
  /// for 3 s of wall time, then every 10 s.
  /// @throws std::runtime_error if it does not advance and no living node publishes /clock
  void look(const ros::Time& time);

 private:
  ros::Time last_;
  ros::SteadyTime next_;  ///< when to look who publishes; zero: not looked yet
};

/// Waits until ROS time is not zero.
/// @param patience longest wait, in wall time
/// @return one line (what is wrong and what to do) if ROS time is still zero; otherwise empty
std::string standing_clock(const ros::WallDuration& patience);

}  // namespace anthrob
