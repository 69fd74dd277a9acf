#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "anthrob_sim/core/errors.h"
#include "anthrob_sim/friction/friction_law.h"
#include "anthrob_sim/inputs.h"
#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/muscle/muscle.h"

namespace anthrob {

/// A complete state of a simulation; copy it, keep it, restore it.
struct Snapshot {
  std::uint64_t step_index = 0;
  std::vector<double> state;  ///< of all components
  std::vector<BodyState> bodies;
  std::vector<double> q, effort, load;  ///< of joints
  std::vector<double> posture;          ///< imposed posture; empty: none
  std::vector<Wrench> wrenches;         ///< that push from outside
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
  ~Simulation();

  const RobotModel& model() const;
  double step_length() const;
  /// [s] since the start, exactly the number of steps times step_length
  double time() const;

  /// @throws BadInput for an index out of range, a reference that is not finite, a mode the muscle
  /// lacks
  void command(int muscle, ecu::Mode mode, double reference);
  /// Everything else that drives muscles: enable, gains, voltages, imposed motions.
  MuscleInputs& muscle_inputs();
  const MuscleInputs& muscle_inputs() const;
  /// Applies an effort to a driven joint from now on [Nm, N].
  /// @throws BadInput if the joint is not driven, or the effort is not finite
  void apply_effort(int joint, double effort);
  /// Applies an external load to a hinge or prismatic joint from now on [Nm, N].
  /// @throws BadInput for another joint or a load that is not finite
  void apply_load(int joint, double load);
  /// The posture in which the joints are held, if any.
  ImposedPosture& imposed_posture();
  const ImposedPosture& imposed_posture() const;

  /// What pushes its links.
  ExternalWrenches& external_wrenches();
  const ExternalWrenches& external_wrenches() const;

  /// Puts the robot at rest into a posture, with its actuators at given positions and relaxed
  /// springs. Muscles move there from the rest posture in small steps, so that wrapping states are
  /// those of a continuous motion. Commands, time and noise continue; an imposed posture is
  /// released, and so are wrenches.
  /// @param q joint positions, size position_count
  /// @param positions actuator positions, one per muscle [rad]
  /// @throws BadInput for other sizes, numbers that are not finite, or positions that an actuator
  /// cannot take; nothing has changed then
  void place(const std::vector<double>& q, const std::vector<double>& positions);
  /// Resets the robot to its initial state. Time continues, and muscles stay enabled or disabled.
  void reset();
  /// Advances time without motion, so that a posture placed next gets its own time stamp.
  void skip(std::uint64_t steps);

  /// @throws NumericalFailure naming time and place; the simulation stays in the failed state
  void step(int count = 1);

  std::size_t muscle_count() const;
  /// This and the following accessors throw BadInput for an index out of range, such as -1 for an
  /// unknown name.
  const Muscle& muscle(int i) const;
  const std::vector<BodyState>& bodies() const;
  const KinematicTree& tree() const;
  /// Joint positions: 1 number, or w, x, y, z of a ball joint.
  const std::vector<double>& configuration() const;
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

  /// About the last step.
  struct LastStep {
    double joint_dissipation;  ///< power dissipated by joint friction and stops [W]
    int solver_iterations;     ///< sweeps of the solver of resistances
  };
  LastStep last_step() const;
  /// Generalised forces of a joint's friction and stops in the last step [Nm, N]: one number, or
  /// three in the child's axes.
  Vec3 joint_resistance(int joint) const;
  /// Inverse dynamics: what a joint lacks in the last step to follow the imposed posture by itself.
  struct LackingEffort {
    double inertial;   ///< of `range`: mass matrix times acceleration
    ForceRange range;  ///< that must be added to its effort; wide where the joint may be held
  };
  /// Acceleration is the change of velocity in the step: mass matrix times acceleration plus bias
  /// forces, less effort, load, wrenches, joint torques, friction and stops, over the part of an
  /// effort that reaches the joint. All states evolve along the imposed motion.
  /// @param rest [rad/s, m/s] a joint that is not faster may be at rest: its dry friction is then
  /// any that can hold it
  /// @throws BadInput for a ball joint, a robot with muscles, or if no posture was imposed
  LackingEffort lacking_effort(int joint, double rest) const;
  /// What presliding friction of joints could give back now [J].
  double presliding_energy() const;
  /// From the next step on, the forces that joints carry are computed; see joint_reaction().
  void observe_reactions();
  /// The force with which the parent held the child in the last step [N], in the parent link's
  /// axes: the weight of what hangs on it, if that is at rest. Zero before the first step.
  /// @throws BadInput if nobody called observe_reactions()
  Vec3 joint_reaction(int joint) const;

  Snapshot snapshot() const;
  /// @throws BadInput for a snapshot of another model
  void restore(const Snapshot& snapshot);
  /// The same, but time continues, by less than a tick: so much that controllers and sensors tick
  /// as they did then. Noise is that of the new time.
  void restore_in_present(const Snapshot& snapshot);

 private:
  class Parts;
  void check_place(const std::vector<double>& q, const std::vector<double>& positions) const;
  void check_joint(int joint) const;

  std::unique_ptr<Parts> parts_;
};

/// Energies of the skeleton, springs and presliding friction on joints included; those of muscles
/// are in Muscle.
struct EnergyAudit {
  double kinetic, potential;  ///< [J]
};
EnergyAudit audit_energy(const Simulation& sim);

}  // namespace anthrob
