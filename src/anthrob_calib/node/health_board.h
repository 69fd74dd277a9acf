#pragma once

#include <ros/ros.h>

#include <filesystem>
#include <string>

namespace anthrob {

/// The latched topic `health`, from the history in a folder: at the start, and whenever a test was
/// added, by whichever program.
class HealthBoard {
 public:
  /// @param folder of health.csv; empty: nothing is published
  /// @param frame of the messages
  HealthBoard(ros::NodeHandle nh, const std::string& folder, const std::string& frame);

 private:
  void look();

  std::string frame_, file_;
  std::filesystem::file_time_type written_;
  ros::Publisher publisher_;
  ros::WallTimer timer_;
};

}  // namespace anthrob
