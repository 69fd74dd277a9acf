#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anthrob_control/computed_force.h"

namespace anthrob {

/// The last measurement of every muscle and joint of a robot, from sources that come and go.
/// Free of clocks and of ROS: stamps come in as arguments [s].
class RobotState {
 public:
  explicit RobotState(std::shared_ptr<const RobotModel> model);

  void see_muscle(const std::string& name, const ecu::Measurement& measured, bool enabled,
                  double stamp);
  /// What a muscle's motor follows. A robot need not tell.
  void see_mode(const std::string& name, ecu::Mode mode);
  /// Unknown names are passed over: a robot may carry more than the model.
  void see_joint(const std::string& name, double position, double velocity, double stamp);
  void see_ball_joint(const std::string& name, const Quat& orientation, const Vec3& velocity,
                      double stamp);

  /// Why one cannot control with what is known at `now`; empty if one can. Values that are not
  /// finite, or no rotation, count as not measured; forces alone may be NaN, where there is no
  /// sensor. Muscles that take no input, such as ligaments, need no measurement: no unit has them.
  std::string complaint(double now, double stale_after) const;
  /// The same of the muscles alone.
  std::string complaint_of_muscles(double now, double stale_after) const;
  /// Whether all that must be was measured at `stamp` or later.
  bool complete_since(double stamp) const;
  /// The first muscle whose ECU does not follow references, or empty.
  std::string disabled_muscle() const;
  /// The first muscle with a controller that is enabled and follows something else, or empty: what
  /// it was told was refused.
  std::string muscle_not_in(ecu::Mode mode) const;
  /// The first muscle with a controller whose force is not a number, or empty: it has no sensor.
  std::string muscle_without_force() const;
  /// The first muscle that was seen not to follow references since the last call, or empty: one
  /// that was stopped and enabled again between two looks is enabled now, and elsewhere than it was
  /// told. One that was not measured was not seen.
  std::string take_disabled();
  /// Forgets all, as when time jumps back.
  void clear();

  const RobotMeasurement& measurement() const { return measured_; }
  const RobotModel& model() const { return *model_; }

 private:
  bool must_be_measured(std::size_t muscle) const;

  std::shared_ptr<const RobotModel> model_;
  RobotMeasurement measured_;
  std::vector<double> muscle_stamps_, joint_stamps_;
  std::vector<char> enabled_;
  std::vector<std::optional<ecu::Mode>> mode_;
  int was_disabled_ = -1;  // index of the muscle that take_disabled names
};

}  // namespace anthrob
