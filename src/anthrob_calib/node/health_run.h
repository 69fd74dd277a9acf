#pragma once

#include <anthrob_control/ros/robot_link.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "health/protocol.h"

namespace anthrob {

/// A test of a robot's tendons, from an arm at rest to its recording. Ends early, with slack
/// tendons, if a joint moves too far, a motor stops, or the robot is silent.
class HealthRun {
 public:
  HealthRun(ros::NodeHandle nh, std::shared_ptr<const RobotModel> model,
            const RobotLink::Options& link, const health::HealthOptions& options);

  /// @return nothing if ROS shut down first
  /// @throws std::runtime_error with one line: why the robot cannot be tested, or why the test
  /// ended
  std::optional<Dataset> run();
  const health::TestProtocol& protocol() const { return *protocol_; }

 private:
  bool wait_for_robot();
  void require_rest() const;
  bool let_out();
  bool follow_protocol();
  /// @throws std::runtime_error after the tendons were let out
  void watch(double time);
  void send(const std::vector<double>& references);
  void record(const RobotLink& link);

  std::shared_ptr<const RobotModel> model_;
  health::HealthOptions options_;
  RobotLink link_;
  std::unique_ptr<health::TestProtocol> protocol_;
  std::vector<double> posture_;  ///< at the beginning
  std::optional<ros::Time> begin_;
  ros::Time sent_;
  int away_ = 0;  ///< periods in a row in which a joint was too far away
  Dataset recording_;
};

}  // namespace anthrob
