#pragma once

#include <vector>

#include "anthrob_control/robot_state.h"

namespace anthrob {

struct SettleOptions {
  double actuator_velocity = 0.02;  ///< [rad/s]
  double joint_velocity = 0.01;     ///< [rad/s]
  double window = 0.5;              ///< over which velocities are taken [s]
  double timeout = 20.0;            ///< [s]
};

/// Detects when a robot has come to rest: within the window, nothing has moved further than the
/// allowed velocity times the window. Uses positions, because measured velocities are noisy.
class SettleDetector {
 public:
  SettleDetector(std::shared_ptr<const RobotModel> model, const SettleOptions& options);

  /// Starts again at `time` [s].
  void start(double time);
  /// @return whether the robot has settled
  bool step(const RobotMeasurement& measured, double time);

 private:
  bool moved(const RobotMeasurement& measured) const;

  std::shared_ptr<const RobotModel> model_;
  SettleOptions options_;
  RobotMeasurement anchor_;
  double anchor_time_ = 0.0;
  bool anchored_ = false;
};

}  // namespace anthrob
