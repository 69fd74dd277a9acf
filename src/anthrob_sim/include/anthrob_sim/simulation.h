#pragma once

#include <memory>
#include <vector>

#include "anthrob_sim/core/errors.h"
#include "anthrob_sim/friction/resistance_solver.h"
#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/muscle/muscle.h"
#include "anthrob_sim/reading_chain.h"
#include "anthrob_sim/skeleton/joint_loads.h"
#include "anthrob_sim/skeleton/skeleton.h"

namespace anthrob {

/// A complete state of a simulation; copy it, keep it, restore it.
struct Snapshot {
  std::uint64_t step_index = 0;
  std::vector<double> state;  ///< of all components
  std::vector<BodyState> bodies;
  std::vector<double> q, effort, load;  ///< of joints
  std::vector<double> posture;          ///< imposed posture; empty: none
};

/// A robot in motion. Deterministic: same model, same calls, same bits. Does not allocate while
/// stepping.
///
/// One step, from t to t + h:
///   controllers tick on what the sensors saw at t; friction, stops and tensions are solved for the
///   motion of this step; actuators move; Bullet moves the bodies; paths, springs and sensors
///   follow.
class Simulation {
 public:
  /// Larger values, in SI units, are refused, or count as a numerical failure.
  static constexpr double kSensible = 1e9;

  /// Starts in the rest posture, with all actuators at position 0 and controllers enabled. There is
  /// no reference yet: the motors get 0 V.
  explicit Simulation(std::shared_ptr<const RobotModel> model);

  const RobotModel& model() const { return *model_; }
  double step_length() const { return model_->step; }
  /// [s] since the start, exactly the number of steps times step_length
  double time() const { return static_cast<double>(step_index_) * model_->step; }

  /// @throws BadInput for an index out of range, a reference that is not finite, a mode the muscle
  /// lacks
  void command(int muscle, ecu::Mode mode, double reference);
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
  void release(int muscle);
  /// Applies an effort to a driven joint from now on [Nm, N].
  /// @throws BadInput if the joint is not driven, or the effort is not finite
  void apply_effort(int joint, double effort);
  /// Applies an external load to a hinge or prismatic joint from now on [Nm, N].
  /// @throws BadInput for another joint or a load that is not finite
  void apply_load(int joint, double load);

  /// Imposes a posture until release_posture(): at the end of every step the joints are at `q`,
  /// whatever forces act on them. Muscles are stretched as in a recorded motion.
  /// @param q size position_count   @throws BadInput as place()
  void impose_posture(const std::vector<double>& q);
  /// Imposes the posture for which the sensors read `q`, as in a recording. If the sensors are
  /// late, take `q` from later in the recording, by posture_delay().
  void impose_posture_reading(const std::vector<double>& q);
  /// The posture [rad, m, quaternions] in which the sensors read this one, as place() takes it.
  std::vector<double> true_posture(std::vector<double> read) const;
  /// Delay of the joint sensors by effects of the model [s].
  double posture_delay() const;
  void release_posture() { posture_.clear(); }

  /// Puts the robot at rest into a posture, with its actuators at given positions and relaxed
  /// springs. Muscles move there from the rest posture in small steps, so that wrapping states are
  /// those of a continuous motion. Commands, time and noise continue; an imposed posture is
  /// released.
  /// @param q joint positions, size position_count
  /// @param positions actuator positions, one per muscle [rad]
  /// @throws BadInput for other sizes, numbers that are not finite, or positions that an actuator
  /// cannot take; nothing has changed then
  void place(const std::vector<double>& q, const std::vector<double>& positions);
  /// Resets the robot to its initial state. Time continues, and muscles stay enabled or disabled.
  void reset();
  /// Advances time without motion, so that a posture placed next gets its own time stamp.
  void skip(std::uint64_t steps) { step_index_ += steps; }

  /// @throws NumericalFailure naming time and place; the simulation stays in the failed state
  void step(int count = 1);

  std::size_t muscle_count() const { return muscles_.size(); }
  /// This and the following accessors throw BadInput for an index out of range, such as -1 for an
  /// unknown name.
  const Muscle& muscle(int i) const;
  const std::vector<BodyState>& bodies() const { return skeleton_.bodies(); }
  const KinematicTree& tree() const { return tree_; }
  /// Joint positions: 1 number, or w, x, y, z of a ball joint.
  const std::vector<double>& configuration() const { return q_; }
  /// Measured position of a hinge or prismatic joint [rad, m]; for a ball joint the component w.
  double measured_joint_position(int joint) const;
  /// Readings of a muscle's ideal sensors: true values, plus the systematic errors that are effects
  /// of the model.
  ecu::Measurement reading(int muscle) const;
  /// The same for joints: positions as in configuration(), and velocities (of ball joints in the
  /// child's axes).
  const double* read_positions() const;
  Vec3 read_ball_velocity(int joint) const;
  double read_velocity(int joint) const;
  double joint_effort(int joint) const;
  double joint_load(int joint) const;
  /// Moment arms -dl/dq of a muscle [m], one per generalised velocity (ball joints in the child's
  /// axes).
  std::vector<double> moment_arms(int muscle) const;
  /// Pose of a link in the world.
  Pose link_pose(int frame) const;

  /// Kinetic and potential energy of the skeleton, springs on joints included [J].
  double kinetic_energy() const;
  double potential_energy() const;
  /// Power dissipated by joint friction and stops in the last step [W].
  double joint_dissipation() const { return store_.at(dissipation_offset_)[0]; }
  int solver_iterations() const { return resistance_.iterations(); }

  Snapshot snapshot() const;
  void restore(const Snapshot& snapshot);

 private:
  void settle_in(const std::vector<BodyState>& bodies);
  void reserve_effects();
  void reset_effects();
  void add_joint_torques();
  void head_for_posture();
  void move_skeleton();
  void advance_actuators();
  ReadingChain::Truth truth() const { return {muscles_, q_, tree_}; }
  void step_once();
  void apply_wrenches();
  void sense();
  void apply_joint_efforts();
  void check_finite() const;
  void check_posture(const std::vector<double>& q) const;
  void check_place(const std::vector<double>& q, const std::vector<double>& positions) const;
  void check_muscle(int muscle) const;
  void check_joint(int joint) const;

  std::shared_ptr<const RobotModel> model_;
  mutable StateStore store_;  ///< components hold views of it
  Skeleton skeleton_;
  KinematicTree tree_;
  ResistanceSolver resistance_;
  std::vector<Muscle> muscles_;
  ReadingChain readings_;
  std::vector<SlidingTendon*> sliding_;
  std::vector<Sensor> joint_sensors_;
  std::vector<double> q_, effort_, load_;
  std::vector<double> posture_;      ///< imposed posture; empty: none
  Eigen::VectorXd way_;              ///< scratch: velocities that reach it in one step, child axes
  std::vector<double> heading_;      ///< scratch: the same, ball joints in world axes
  std::vector<BodyState> arriving_;  ///< scratch: body states at it
  std::size_t measured_offset_;      ///< measured joint positions
  std::vector<std::size_t> joint_sensor_offsets_;
  Eigen::VectorXd tau_;
  // Of effects: empty in a plain model.
  JointLoads joint_loads_;
  Eigen::VectorXd joint_torque_;  ///< of joint_torques
  std::vector<PowerLine> lines_;  ///< scratch of power_effects
  std::size_t loads_offset_ = 0;
  std::vector<std::size_t> power_offsets_;
  std::size_t dissipation_offset_ = 0;
  std::uint64_t step_index_ = 0;
};

}  // namespace anthrob
