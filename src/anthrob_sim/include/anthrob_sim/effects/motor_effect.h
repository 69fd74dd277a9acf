#pragma once

#include "anthrob_sim/actuator/dc_motor.h"
#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {

/// MUSCLE | all, muscles with a DC motor: another motor in place of the plain one.
/// Stage::kNumbers.
class MotorEffect : public MuscleEffect {
 public:
  using MuscleEffect::MuscleEffect;

 protected:
  bool fits(const MuscleModel& muscle) const override { return muscle.motor() != nullptr; }
  void change(const EffectSetting& setting, ModelDraft& draft, std::size_t muscle) const override {
    MuscleModel& model = draft.robot.muscles[muscle];
    const auto plain = std::dynamic_pointer_cast<const DcMotor>(model.actuator);
    if (!plain) setting.fail("place", "a muscle with a plain DC motor");
    change_motor(setting, *plain, draft.robot.step, model);
  }
  virtual void change_motor(const EffectSetting& setting, const DcMotor& motor, double step,
                            MuscleModel& muscle) const = 0;
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

/// MUSCLE | all, muscles with a motor of any kind: a wrapper around the motor. Stage::kComponents.
class MotorWrappingEffect : public MuscleEffect {
 public:
  using MuscleEffect::MuscleEffect;

 protected:
  bool fits(const MuscleModel& muscle) const override { return muscle.motor() != nullptr; }
  void change(const EffectSetting& setting, ModelDraft& draft, std::size_t muscle) const override {
    MuscleModel& model = draft.robot.muscles[muscle];
    model.actuator = wrap(setting, std::dynamic_pointer_cast<const GearedMotor>(model.actuator),
                          draft.robot.step);
  }
  virtual std::shared_ptr<const Actuator> wrap(const EffectSetting& setting,
                                               std::shared_ptr<const GearedMotor> motor,
                                               double step) const = 0;
};

}  // namespace anthrob
