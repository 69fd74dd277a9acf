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
