#pragma once

#include <string>
#include <vector>

#include "anthrob_ecu/control_law.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {

/// How a joint is held.
struct JointGains {
  double stiffness = 0.0;  ///< [Nm/rad]
  double damping = 0.0;    ///< [Nms/rad]
  double integral = 0.0;   ///< on the way to a posture [Nm/(rad s)]
  double yield = 0.0;      ///< torque beyond which the held posture gives way, zero gravity [Nm]
  double strength = 0.0;   ///< largest correcting torque on the way to a posture [Nm]
  double fastest = 4.0;    ///< highest speed that may be asked for on that way [rad/s]
};

/// Settings of the computed-force controller: a YAML file beside the robot's models, see
/// config/anthrob/control.yaml.
struct ControlSettings {
  double rate = 200.0;  ///< [Hz]
  /// What the ECUs are told: FORCE, VOLTAGE (the ECU's force law, run here) or POSITION (that of
  /// the relaxed spring). While a posture is held in zero gravity, and on the way to one.
  ecu::Mode hold_output = ecu::Mode::kForce, move_output = ecu::Mode::kPosition;
  double lowest_tension = 2.0;     ///< keeps tendons from going slack [N]
  double highest_tension = 80.0;   ///< [N]; a muscle's own limit counts where it is lower
  double position_cutoff = 10.0;   ///< [Hz]
  double velocity_cutoff = 10.0;   ///< [Hz]
  double stale_after = 0.1;        ///< age at which a measurement no longer counts [s]
  std::vector<JointGains> joints;  ///< in the robot's order

  /// @throws BadInput with one line
  static ControlSettings load(const std::string& file, const RobotModel& model);
};

}  // namespace anthrob
