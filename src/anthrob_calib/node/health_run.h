#pragma once

#include <anthrob_control/ros/reference_watch.h>
#include <anthrob_control/ros/robot_link.h>

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "health/protocol.h"

namespace anthrob {

/// A test of a robot's tendons, from an arm at rest to its recording. Ends early if a joint moves
/// too far, a tendon pulls more than it should, a motor stops, the references are not followed, or
/// the robot is silent. Then the tendons are let out; a silent robot gets no commands any more.
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
  /// What is wrong now, in one line; nothing is.
  std::optional<std::string> trouble();
  std::optional<std::string> other_reference();
  void let_go();
  void send(const std::vector<double>& references);

  std::shared_ptr<const RobotModel> model_;
  health::HealthOptions options_;
  bool lock_step_;
  RobotLink link_;
  std::unique_ptr<health::TestProtocol> protocol_;
  std::vector<double> posture_;  ///< at the beginning
  std::optional<ros::Time> begin_;
  ros::Time sent_;
  ReferenceWatch reference_watch_;
  std::deque<std::pair<ros::Time, std::vector<double>>> asked_;  ///< of the last moments
  std::map<std::string, double> echoed_;                         ///< references, by muscle [rad]
  int unheard_ = 0;  ///< grows while another reference is followed
  int away_ = 0;     ///< periods in a row in which a joint was too far away
  Dataset recording_;
};

}  // namespace anthrob
