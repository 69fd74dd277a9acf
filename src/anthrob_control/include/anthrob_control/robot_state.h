#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_control/computed_force.h"

namespace anthrob {

/// The last measurement of every muscle and joint of a robot, from sources that may fail at any
/// time. Uses neither a clock nor ROS: stamps are arguments [s]. Names that the model lacks are
/// ignored, because a robot may have more parts than the model.
class RobotState {
 public:
  explicit RobotState(std::shared_ptr<const RobotModel> model);

  void see_muscle(const std::string& name, const ecu::Measurement& measured, bool enabled,
                  double stamp);
  /// When all that is seen from now on is received, by the clock of `now`. Without it, measurements
  /// are as old as their stamps say.
  void receive_at(double now) { received_ = now; }
  /// The control mode of a muscle's motor. Not every robot reports it.
  void see_mode(const std::string& name, ecu::Mode mode);
  /// A position that is further from the last one than a joint can move meanwhile is not taken:
  /// complaint() tells it, until the joint is where it was, or has stayed elsewhere for 0.2 s.
  void see_joint(const std::string& name, double position, double velocity, double stamp);
  void see_ball_joint(const std::string& name, const Quat& orientation, const Vec3& velocity,
                      double stamp);

  /// The first joint or muscle that was not measured, or received, within `stale_after` before
  /// `now`, as one line; none if all were. Values that are not finite, or not a rotation, count as
  /// not measured. Only forces may be NaN, where there is no sensor. Muscles without input, such as
  /// ligaments, need no measurement, because no unit measures them.
  std::optional<std::string> complaint(double now, double stale_after) const;
  /// The same for muscles only.
  std::optional<std::string> complaint_of_muscles(double now, double stale_after) const;
  /// Whether everything that must be measured was measured at `stamp` or later.
  bool complete_since(double stamp) const;
  /// The first muscle whose ECU does not follow references, if any.
  std::optional<std::string> disabled_muscle() const;
  /// The first muscle with a controller that is enabled but in another mode, if any. Such a
  /// muscle has refused its commands.
  std::optional<std::string> muscle_not_in(ecu::Mode mode) const;
  /// The first muscle with a controller whose force is NaN (it has no sensor), if any.
  std::optional<std::string> muscle_without_force() const;
  /// The first muscle that was measured as not enabled since the last call, if any. This also
  /// finds a motor that was stopped and enabled again between two calls: such a motor is enabled,
  /// but no longer at its reference.
  std::optional<std::string> take_disabled();
  /// Whether a joint has been found elsewhere, after a jump, since the last call: what was held
  /// before is not where the joint is.
  bool take_jump();
  /// Forgets all measurements, for example when time jumps back.
  void clear();

  const RobotMeasurement& measurement() const { return measured_; }
  const RobotModel& model() const { return *model_; }

 private:
  /// A position that was not taken yet.
  struct Jump {
    std::array<double, 4> q;  ///< 1 number, or 4 of a ball joint
    double begin, last;       ///< [s] stamps of the first and the last one there
    std::string text;
  };

  double speed_of(std::size_t joint) const;
  /// Whether a joint can be at `q` now.  @param q 1 number, or 4 of a ball joint
  bool is_reachable(std::size_t joint, const double* q, double stamp);
  bool must_be_measured(std::size_t muscle) const;

  std::shared_ptr<const RobotModel> model_;
  RobotMeasurement measured_;
  std::vector<double> muscle_stamps_, joint_stamps_;
  std::vector<double> muscle_receipts_, joint_receipts_;
  double received_ = std::numeric_limits<double>::infinity();
  std::vector<char> enabled_;
  std::vector<std::optional<ecu::Mode>> mode_;
  std::vector<std::optional<Jump>> jumps_;  ///< by joint
  std::vector<double> taken_;               ///< [s] stamps of the positions that were taken
  bool jumped_ = false;
  std::optional<std::size_t> was_disabled_;  // index of the muscle that take_disabled names
};

}  // namespace anthrob
