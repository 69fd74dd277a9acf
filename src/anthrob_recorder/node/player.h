#pragma once

#include <anthrob_msgs/Seek.h>
#include <anthrob_msgs/SetRate.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>

#include <optional>
#include <vector>

#include "playback.h"
#include "played_bag.h"

namespace anthrob {

/// Publishes a recording as if its robot were there, and the clock of that time. Everybody may
/// pause it, go to another place of it, and change its speed.
class Player {
 public:
  /// @param own for what belongs to the player itself, not to the robot
  Player(ros::NodeHandle nh, ros::NodeHandle own, PlayedBag& bag, const Playback::Options& options);

  /// Until the recording has ended.
  /// @return false if ROS shut down first
  bool run();

 private:
  /// @return false at the end
  bool advance(double now);
  void tell_time();
  void tell_state(double now);
  void show_place(double now);
  ros::Time time() const { return bag_.begin() + ros::Duration(playback_.position()); }

  bool on_seek(anthrob_msgs::Seek::Request& request, anthrob_msgs::Seek::Response& response);
  bool on_rate(anthrob_msgs::SetRate::Request& request, anthrob_msgs::SetRate::Response& response);
  bool on_pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);

  PlayedBag& bag_;
  Playback playback_;
  ros::Publisher clock_, state_;
  std::vector<ros::ServiceServer> services_;
  double last_, next_state_ = 0.0, jumped_ = 0.0;  ///< [s] by the monotonic clock
  std::optional<double> show_;                     ///< [s] when the place is to be shown
  ros::Time published_;
};

}  // namespace anthrob
