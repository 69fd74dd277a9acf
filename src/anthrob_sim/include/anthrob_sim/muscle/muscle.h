#pragma once

#include <memory>
#include <vector>

#include "anthrob_ecu/control_law.h"
#include "anthrob_ecu/parameters.h"
#include "anthrob_sim/actuator/actuator.h"
#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/path/muscle_path.h"
#include "anthrob_sim/sensing/sensor.h"

namespace anthrob {

class DelayLine;
class DriveShaft;
class MotorShaft;
struct SlidingTendon;

/// How a muscle is driven for the next steps.
enum class Drive {
  kController,  ///< its ECU follows a reference
  kVoltage,     ///< its power stage gets a voltage from outside, as recorded
  kImposed,     ///< its actuator is moved from outside, as recorded
};

/// One muscle of a running simulation: Algorithm 4.1, divided at its interfaces
///   controller -> actuator -> spring -> path -> skeleton.
/// Holds scratch memory only; its state is in the simulation's StateStore.
class Muscle {
 public:
  /// @param model, skeleton must outlive the muscle   @param index among the robot's muscles
  Muscle(const MuscleModel& model, const SkeletonModel& skeleton, const SensorsModel& sensors,
         int index, double step, StateStore& store);
  Muscle(Muscle&&) noexcept;
  ~Muscle();

  const MuscleModel& model() const { return model_; }

  /// At rest with its actuator at `position`, the spring relaxed, path states evaluated from this
  /// posture.
  void place(const std::vector<BodyState>& bodies, double position);
  /// Follows a posture while the actuator stands still; the spring is relaxed afterwards.
  void follow(const std::vector<BodyState>& bodies);

  void command(ecu::Mode mode, double reference);
  /// Whether the ECU follows its reference; if not, its output is zero volts.
  void set_enabled(bool enabled);
  void set_gain(ecu::Parameter gain, double value);
  /// Settings of the control law, with the current gains.
  const ecu::ControllerSettings& controller() const { return controller_; }
  /// Sets the output of the ECU's control law until release(), without delay. It replaces the
  /// command: after release() the ECU holds this voltage until the next command.
  void apply_voltage(double voltage);
  /// The actuator arrives at `position` at the end of the next step.
  void impose(double position, double velocity);
  void release();
  Drive drive() const { return static_cast<Drive>(static_cast<int>(memory().drive)); }

  /// What the ECU's sensors would measure if they were ideal.
  ecu::Measurement truth() const;
  /// Resets the sensors as if they had always sampled these values.
  void reset_sensors(const ecu::Measurement& seen);
  /// Samples the sensors. @param seen true values, or what effects make of them
  void sense(std::uint64_t step_index, const ecu::Measurement& seen);
  /// Runs the controller if its tick is due.
  void control(std::uint64_t step_index);
  /// Adds the known forces of the muscle to `tau`, and prepares the part of the tendon beyond the
  /// spring, whose tension depends on how the joints will move.
  void prepare_sliding(const KinematicTree& tree, Eigen::VectorXd& tau);
  /// Of a drive: prepares its torque, which depends on how the joint will move.
  /// @param input as in advance_actuator()
  void prepare_drive(const KinematicTree& tree, double input);
  /// Null: a tendon.
  DriveShaft* shaft();
  SlidingTendon& sliding() { return *sliding_; }
  const SlidingTendon& sliding() const { return *sliding_; }
  /// Takes over the solved tensions.
  void finish_sliding();
  /// Moves the actuator.
  /// @param input of the actuator: voltage(), unless an effect lies between
  void advance_actuator(double input);
  /// New posture: path, spring, tensions up to the spring (lines 1-16 of Algorithm 4.1).
  void update(const std::vector<BodyState>& bodies, const KinematicTree& tree);

  /// Recomputes the path from posture and state, after a snapshot was restored.
  void refresh_path(const std::vector<BodyState>& bodies) { path_.update(bodies, path_state()); }

  const MusclePath& path() const { return path_; }
  double length() const { return path_.length(); }
  double tendon_length() const;
  /// l_M - l_T - l_0 [m]
  double expansion() const;
  Actuator::Readout actuator() const;
  const ecu::Measurement& measured() const;
  /// Reading of the force sensor [N], which may be negative; measured() is cut off at zero.
  double force_reading() const;
  ecu::Mode mode() const;
  double reference() const;
  bool enabled() const;
  double voltage() const;
  /// Tension of segment i [N]. Up to the spring: of the posture at the end of the last step. Beyond
  /// the spring, where the tensions are solved together with the motion of the joints: of the
  /// spring's tension at the beginning of that step.
  double tension(std::size_t segment) const;
  double spring_tension() const { return tension(model_.spring_segment); }
  /// Tension at the force sensor [N]. A sensor beyond the spring reads one step late, see
  /// tension().
  double force() const { return tension(model_.sensor_segment); }

  /// Elastic energy of the spring [J], and the power it turns into heat [W].
  double spring_energy() const;
  double spring_dissipation() const;
  /// Power dissipated by friction of the tendon in the last step [W].
  double friction_power() const;

 private:
  struct Control {
    double mode, reference, voltage, enabled;
    double drive, imposed_position, imposed_velocity;
    double expansion;       ///< [m]
    double expansion_rate;  ///< over the last step [m/s]
    double friction_power;  ///< before the spring, over the last step [W]
    double sliding_power;   ///< of friction beyond the spring, over the last step [W]
    ecu::ControllerMemory controller;
    ecu::Measurement measured;
    double force_reading;  ///< [N] what was measured before it is cut off at zero
  };

  StateView spring_state() const { return store_.at(spring_offset_); }
  StateView actuator_state() const { return store_.at(actuator_offset_); }
  StateView path_state() const { return store_.at(path_offset_); }
  StateView contact_state(std::size_t obstacle) const;
  Control& memory() const { return store_.at(control_offset_).as<Control>(); }
  double& tension_slot(std::size_t segment) const { return store_.at(tension_offset_)[segment]; }
  void update_tensions_before_spring(const KinematicTree& tree);
  /// Rate at which the path from the origin to an obstacle gets longer [m/s].
  double path_rate(std::size_t obstacle, const KinematicTree& tree) const;
  /// Puts the motor of a drive with a rigid shaft where its joint is.
  void turn_along();
  void relax();
  /// Clears what a stop discards: the controller's memory and delayed commands.
  void forget();
  double sliding_power() const;
  /// The command that arrives at the controller in this step.
  void delay_command(ecu::Mode& mode, double& reference);

  const MuscleModel& model_;
  ecu::ControllerSettings controller_;
  StateStore& store_;
  double step_;
  MusclePath path_;
  std::unique_ptr<SlidingTendon> sliding_;          ///< never null
  std::unique_ptr<MotorShaft> shaft_;               ///< of a drive; null: a tendon
  std::vector<Sensor> sensors_;                     ///< position, velocity, current, force
  std::unique_ptr<const DelayLine> command_delay_;  ///< null: none
  std::size_t command_delay_offset_ = 0;
  std::size_t spring_offset_, actuator_offset_, path_offset_, control_offset_, tension_offset_;
  std::size_t sensor_offsets_[4];
  std::vector<std::size_t> sliding_obstacles_;  ///< with friction, beyond the spring
  bool path_before_spring_moves_;
  mutable std::vector<double> arms_;  ///< scratch, all generalised velocities
};

}  // namespace anthrob
