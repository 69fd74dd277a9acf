#pragma once

#include <limits>
#include <memory>
#include <string>

#include "anthrob_core/config_node.h"
#include "anthrob_sim/core/state.h"

namespace anthrob {

/// Winds the tendon: turns an input into a tendon length (Figure 4.1). Built for one step length.
class Actuator {
 public:
  /// The quantities that an ECU can measure.
  struct Readout {
    double position;  ///< [rad] gear output, winding in positive
    double velocity;  ///< [rad/s]
    double current;   ///< [A]
  };

  virtual ~Actuator() = default;

  virtual std::size_t state_size() const = 0;

  /// At rest at a position; all currents zero.
  virtual void place(double position, StateView state) const = 0;
  /// Imposes a motion, independently of the input.
  /// @param load as in advance
  virtual void impose(double position, double velocity, double load, StateView state) const = 0;
  /// One step.
  /// @param input volts after the ECU, or excitation of a Hill muscle
  /// @param load tension of the tendon at the actuator [N]
  virtual void advance(double input, double load, StateView state) const = 0;

  virtual Readout read(StateView state) const = 0;

  /// l_T [m]
  virtual double tendon_length(StateView state) const = 0;
  /// Speed at which the tendon is wound in, -dl_T/dt [m/s].
  virtual double winding_speed(StateView state) const = 0;
  /// The position that gives a tendon length, the inverse of tendon_length at rest.
  virtual double position_for(double tendon_length) const = 0;
  /// Largest position [rad]; infinite if the actuator has no end.
  virtual double highest_position() const { return std::numeric_limits<double>::infinity(); }
  /// The input that keeps the actuator at rest at a position under a load [N].
  virtual double holding_input(double position, double load) const = 0;

  /// Range of useful inputs: [-limit, limit] volts, or [0, limit].
  virtual double input_low() const = 0;
  virtual double input_high() const = 0;
  /// Whether the actuator has an input; false for a ligament.
  bool takes_input() const { return input_high() > input_low(); }
};

/// An electric motor with gear and spindle. Effects are wrappers around it: they override what they
/// change and pass on the rest. Their own state follows the state of the wrapped motor.
class GearedMotor : public Actuator {
 public:
  /// One step, with an internal torque in addition to the load of the tendon.
  /// @param torque at the gear output, past the losses of the gear, winding in positive [Nm]
  virtual void advance_with(double input, double load, double torque, StateView state) const = 0;
  void advance(double input, double load, StateView state) const override {
    advance_with(input, load, 0.0, state);
  }

  /// Change of the current per change of the voltage within one step, with the shaft held [A/V].
  virtual double conductance() const = 0;
  /// Inertia of rotor and gear at the motor shaft [kg m^2].
  virtual double inertia() const = 0;
  /// N, and r_S at position 0 [m]
  virtual double ratio() const = 0;
  virtual double spindle_radius() const = 0;
};

/// Builds the actuator of one muscle.
/// @param kind the kind of actuator, as the model file lists it: `{type: dc_motor, ...}`
/// @param muscle what differs from muscle to muscle: `spindle_radius`, `rest_tendon_length`
std::shared_ptr<const Actuator> make_actuator(const ConfigNode& kind, const ConfigNode& muscle,
                                              double step);

/// Builds the motor of a drive, which turns a joint instead of winding a tendon.
/// @param ratio turns of the gear's output per turn of the joint [1], or radians per metre [1/m]
/// @throws BadInput if the kind is no motor
std::shared_ptr<const Actuator> make_drive_motor(const ConfigNode& kind, double ratio, double step);

/// `rest_tendon_length` of a muscle [m]. Throws BadInput above 10 m, as a number meant in
/// millimetres is.
double read_rest_tendon_length(const ConfigNode& muscle);

/// Throws BadInput if a kind of actuator has an unknown `type`.
void require_actuator_type(const ConfigNode& kind);

}  // namespace anthrob
