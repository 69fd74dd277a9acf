#pragma once

#include <cstdint>
#include <string>

#include "anthrob_core/config_node.h"
#include "robot.h"

namespace anthrob::virtual_robot {

/// config/anthrob/virtual_robot_tables.yaml
struct CalibrationRobotSettings {
  double scale = 1.0;
  double rest_tendon_length = 0.0, spindle_radius = 0.0, path_point = 0.0, cylinder_radius = 0.0;
  double viscous_low = 0.0, viscous_high = 0.0;
  double sticking = 0.0, leaving_friction = 0.0, tendon_compliance = 0.0;
  double lowest_tension = 0.0;  ///< of the search for references [N]
  int tries = 1;
  double close = 0.0;  ///< [rad]

  static CalibrationRobotSettings load(const std::string& file);
};

/// The arm with its forearm detached: eight muscles; the forearm that remains has negligible mass.
reference::ArmParameters detached(const reference::ArmParameters& arm);

/// The same arm with errors of calibration; the shoulder of one seed is the same in both tiers.
reference::ArmParameters with_table_errors(const reference::ArmParameters& arm,
                                           const CalibrationRobotSettings& settings,
                                           std::uint64_t seed);

/// Adds the effects that the models lack.
Draft with_hidden(const reference::ArmParameters& arm, const CalibrationRobotSettings& settings);

}  // namespace anthrob::virtual_robot
