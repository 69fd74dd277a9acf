#pragma once

#include <string>
#include <vector>

#include "anthrob_ecu/control_law.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {

/// Gains and limits of one joint; of one that slides with m for rad and N for Nm.
struct JointGains {
  double stiffness = 0.0;  ///< [Nm/rad]
  double damping = 0.0;    ///< [Nms/rad]
  double integral = 0.0;   ///< only on the way to a posture [Nm/(rad s)]
  double yield = 0.0;      ///< zero gravity: with more torque than this the joint yields [Nm]
  double strength = 0.0;   ///< largest correcting torque on the way to a posture [Nm]
  double fastest = 4.0;    ///< highest speed that go_to may ask for [rad/s]; of slides 0.4 [m/s]
};

/// Settings of the computed-force controller: a YAML file beside the robot's models, see
/// config/anthrob/control.yaml.
struct ControlSettings {
  double rate = 200.0;  ///< [Hz]
  /// Mode of the commands, in zero gravity and on the way to a posture: FORCE, VOLTAGE (this
  /// controller runs the ECU's force law) or POSITION (where the relaxed spring gives the force).
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
