#pragma once

#include <string>
#include <vector>

#include "anthrob_sim/model/robot_model.h"

namespace anthrob {

class Simulation;

/// @param what they are, such as "joint"   @throws BadInput that says which name comes twice
void refuse_repeated(const std::string& what, const std::vector<std::string>& names);

/// Collects a requested posture for Simulation::place, and checks every value against the limits of
/// its joint or muscle. All setters throw BadInput that names the joint or muscle.
class Placement {
 public:
  /// Accepted distance beyond a soft stop, which yields a little, so that recorded postures can be
  /// restored. For a prismatic joint a tenth of that in metres.
  static constexpr double kGive = 0.05;  // [rad]

  /// Starts from rest, with all actuators at 0.   @param model must outlive the object
  explicit Placement(const RobotModel& model);
  /// Starts from joint positions as Simulation::place takes them, with all actuators at 0.
  Placement(const RobotModel& model, std::vector<double> q);
  /// Starts from the current posture and actuator positions of a simulation.
  explicit Placement(const Simulation& sim);

  /// @param position of a hinge [rad] or prismatic joint [m], within its stop
  void set_joint(const std::string& name, double position);
  /// @param turn from rest, in the child's axes; unit within 1e-3, within the joint's stop
  void set_ball_joint(const std::string& name, const Quat& turn);
  /// @param position [rad] within the limits of commands
  void set_muscle(const std::string& name, double position);

  const std::vector<double>& q() const { return q_; }
  const std::vector<double>& positions() const { return positions_; }

 private:
  const RobotModel& model_;
  std::vector<double> q_, positions_;
};

}  // namespace anthrob
