#pragma once

#include <cstdint>
#include <vector>

#include "anthrob_ecu/control_law.h"
#include "anthrob_ecu/parameters.h"
#include "anthrob_sim/skeleton/kinematic_tree.h"
#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {

class Muscle;
class ReadingChain;

/// What drives the muscles of a simulation beside commands; Simulation::muscle_inputs().
/// All functions throw BadInput for an index out of range.
class MuscleInputs {
 public:
  /// @param muscles, readings must outlive it   @param step [s]
  MuscleInputs(std::vector<Muscle>& muscles, const ReadingChain& readings, double step)
      : muscles_(muscles), readings_(readings), step_(step) {}

  void set_enabled(int muscle, bool enabled);
  /// Sets a gain of the muscle's controller from the next tick on. Like the numbers of the model, a
  /// gain is not part of the state: snapshot(), restore() and reset() leave it unchanged.
  /// @throws BadInput if the muscle has no controller, the parameter is no gain, or the value is
  /// outside of its range
  void set_gain(int muscle, ecu::Parameter gain, double value);
  /// Applies a voltage [V], cut off at the power stage's limit, instead of the last command and
  /// past the control law and the delay of commands. After release() it is a command like any
  /// other.
  void apply_voltage(int muscle, double voltage);
  /// Imposes a motion until release(): at the end of every step the actuator is at `position` [rad]
  /// with `velocity` [rad/s].
  /// @throws BadInput for numbers that are not finite, or a position that the actuator cannot take
  void impose_position(int muscle, double position, double velocity);
  /// Imposes the motion for which the position sensor reads `to` [rad] at the end of the step,
  /// having read `from` one step before, as in a recording. If the sensor is late, take both values
  /// from later in the recording, by position_delay().
  void impose_reading(int muscle, double from, double to);
  /// Delay of a muscle's position sensor by effects of the model [s].
  double position_delay(int muscle) const;
  /// Ends apply_voltage() and impose_...().
  void release(int muscle);

 private:
  Muscle& at(int muscle) const;

  std::vector<Muscle>& muscles_;
  const ReadingChain& readings_;
  double step_;
};

/// A posture in which the joints are held, whatever forces act on them; Simulation::
/// imposed_posture(). Muscles are stretched as in a recorded motion.
class ImposedPosture {
 public:
  /// @param skeleton, readings must outlive it
  ImposedPosture(const SkeletonModel& skeleton, const ReadingChain& readings);

  /// From now on, at the end of every step the joints are at `q`, until release().
  /// @param q size position_count   @throws BadInput as Simulation::place()
  void impose(const std::vector<double>& q);
  /// Imposes the posture for which the sensors read `q`, as in a recording. If the sensors are
  /// late, take `q` from later in the recording, by delay().
  void impose_reading(const std::vector<double>& q);
  /// The posture [rad, m, quaternions] in which the sensors read this one.
  std::vector<double> true_posture(std::vector<double> read) const;
  /// Delay of the joint sensors by effects of the model [s].
  double delay() const;
  void release() { q_.clear(); }

  bool active() const { return !q_.empty(); }
  /// Empty while no posture is imposed.
  const std::vector<double>& q() const { return q_; }

 private:
  friend class Simulation;  // restores it

  const SkeletonModel& skeleton_;
  const ReadingChain& readings_;
  std::vector<double> q_;
};

/// A force and a torque on a link, from outside.
struct Wrench {
  int frame = -1;                ///< the link, as of SkeletonModel::find_frame()
  Vec3 point = Vec3::Zero();     ///< where the force acts, in the link's frame [m]
  Vec3 force = Vec3::Zero();     ///< world [N]
  Vec3 torque = Vec3::Zero();    ///< world [Nm]
  std::uint64_t steps_left = 1;  ///< for how long
};

/// What pushes the links of a simulation from outside; Simulation::external_wrenches().
class ExternalWrenches {
 public:
  static constexpr std::size_t kMost = 1000;

  explicit ExternalWrenches(const SkeletonModel& skeleton) : skeleton_(skeleton) {}

  /// Pushes from the next step on, beside all others; instead of one at the same point of the same
  /// link. None at this point if there are no steps. The world may be pushed, too: it stays.
  /// @throws BadInput for an unknown link, numbers that are not sensible, or more than kMost at
  /// once; nothing has changed then
  void push(const Wrench& wrench);
  void release() { acting_.clear(); }
  /// Those of the next step.
  const std::vector<Wrench>& acting() const { return acting_; }

  /// What one step of them does to a body: force [N] and torque about its centre of mass [Nm].
  struct OnBody {
    int body;
    Vec3 force_W, torque_W;
  };
  OnBody on_body(const Wrench& wrench, const std::vector<BodyState>& bodies) const;
  /// Adds the generalised forces of all of them: as KinematicTree's velocities.
  void add_generalised(const KinematicTree& tree, const std::vector<BodyState>& bodies,
                       Eigen::VectorXd& tau) const;

 private:
  friend class Simulation;  // restores them, and lets them end

  void count_step();

  const SkeletonModel& skeleton_;
  std::vector<Wrench> acting_;
};

}  // namespace anthrob
