#pragma once

#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <map>
#include <string>
#include <vector>

namespace anthrob {

/// What a bag says of a robot's state: muscles, joints and touch. Commands are left alone: nothing
/// is to move by them.
class PlayedBag {
 public:
  /// A bag has topics by their whole names, or, if rosbag recorded within the robot's namespace, as
  /// they were written there.
  /// @param robot its namespace from the root, without the first slash
  /// @throws BadInput if the file is no bag, or holds nothing of the robot
  PlayedBag(const std::string& file, const std::string& robot);

  const std::string& file() const { return file_; }
  ros::Time begin() const { return begin_; }
  /// [s]
  double duration() const { return (end_ - begin_).toSec(); }

  void advertise(ros::NodeHandle& nh);
  /// Messages that are later than one time and not later than the other.
  void publish(ros::Time after, ros::Time until);
  /// Of each topic the last message that is not later.
  void publish_last(ros::Time until);

 private:
  void choose_topics(const std::string& robot);
  void publish(const rosbag::MessageInstance& message);

  std::string file_;
  rosbag::Bag bag_;
  std::vector<std::string> topics_;  ///< as the bag names them
  ros::Time begin_, end_;
  std::map<std::string, ros::Publisher> publishers_;  ///< by these
};

}  // namespace anthrob
