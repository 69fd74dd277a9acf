#pragma once

#include <ros/time.h>

#include "anthrob_control/robot_state.h"

namespace anthrob {

/// Whether a robot follows the POSITION references that it is sent. One whose units have no zero,
/// or that takes the sender's clock for wrong, stays enabled, refuses each, and nothing moves.
class HeedWatch {
 public:
  /// Once a period, while references are sent.
  /// @param sure whether what is sent arrives, as in lock-step; else it may take a while of wall
  /// time, too, until they are connected
  /// @throws std::runtime_error naming a muscle that follows something else for a second
  void look(const RobotState& state, const ros::Time& now, bool sure);

 private:
  ros::Time since_;
  ros::WallTime wall_since_;
};

}  // namespace anthrob
