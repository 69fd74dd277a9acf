#pragma once

#include "anthrob_sim/actuator/actuator.h"

namespace anthrob {

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

/// Wraps a motor: passes every call on to it, except for those that a subclass overrides.
class MotorWrapper : public GearedMotor {
 public:
  explicit MotorWrapper(std::shared_ptr<const GearedMotor> inner) : inner_(std::move(inner)) {}

  std::size_t state_size() const override { return inner_->state_size(); }
  void place(double position, StateView state) const override { inner_->place(position, state); }
  void impose(double position, double velocity, double load, StateView state) const override {
    inner_->impose(position, velocity, load, state);
  }
  void advance_with(double input, double load, double torque, StateView state) const override {
    inner_->advance_with(input, load, torque, state);
  }
  Readout read(StateView state) const override { return inner_->read(state); }
  double tendon_length(StateView state) const override { return inner_->tendon_length(state); }
  double winding_speed(StateView state) const override { return inner_->winding_speed(state); }
  double position_for(double tendon_length) const override {
    return inner_->position_for(tendon_length);
  }
  double holding_input(double position, double load) const override {
    return inner_->holding_input(position, load);
  }
  double input_low() const override { return inner_->input_low(); }
  double input_high() const override { return inner_->input_high(); }
  double conductance() const override { return inner_->conductance(); }
  double inertia() const override { return inner_->inertia(); }
  double ratio() const override { return inner_->ratio(); }
  double spindle_radius() const override { return inner_->spindle_radius(); }

 protected:
  /// State of the subclass, behind that of the inner motor.
  StateView own(StateView state) const { return state.from(inner_->state_size()); }
  const GearedMotor& inner() const { return *inner_; }

 private:
  std::shared_ptr<const GearedMotor> inner_;
};

}  // namespace anthrob
