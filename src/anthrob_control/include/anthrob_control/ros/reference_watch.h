#pragma once

#include <ros/time.h>

#include "anthrob_control/robot_state.h"

namespace anthrob {

/// Checks that a robot follows the POSITION references that it receives. A robot whose units have
/// no zero, or that takes the sender's clock for wrong, stays enabled but refuses every reference,
/// and nothing moves.
class ReferenceWatch {
 public:
  /// To be called once a period while references are sent.
  /// @param sure whether every reference arrives, as in lock-step; otherwise a second of wall time
  /// must pass as well, because the connection may take a while to be established
  /// @throws std::runtime_error naming a muscle that has been in another mode for a second
  void look(const RobotState& state, const ros::Time& now, bool sure);

 private:
  ros::Time since_;
  ros::WallTime wall_since_;
};

}  // namespace anthrob
