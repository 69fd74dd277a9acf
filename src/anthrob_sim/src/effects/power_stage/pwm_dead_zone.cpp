#include <algorithm>
#include <cmath>

#include "anthrob_sim/effects/motor_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "pwm_dead_zone";
  i.name = "Dead zone of the power stage";
  i.description =
      "Dead time and threshold of the bridge take away a constant part of the voltage, the same in "
      "both directions: a smaller voltage does not reach the motor. It shortens the duty cycle and "
      "dissipates nothing.";
  i.equation = "V_motor = sign(V) max(0, |V| - width)";
  i.source = "known: 0.1-0.5 V, poor bridges more than 1 V";
  i.where = "MUSCLE | all";
  i.seam = Seam::kPowerStage;
  i.channels = {"current", "position", "velocity"};
  i.parameters = {{"width", "V", "lost voltage", 0.0, 0.3, {0.0, 5.0}}};
  return i;
}

class DeadZone final : public PowerEffect {
 public:
  DeadZone(std::size_t muscle, double width) : muscle_(muscle), width_(width) {}
  void apply(std::vector<PowerLine>& lines, StateView) const override {
    double& voltage = lines[muscle_].voltage;
    voltage = std::copysign(std::max(0.0, std::abs(voltage) - width_), voltage);
  }

 private:
  std::size_t muscle_;
  double width_;
};

class PwmDeadZone final : public MuscleEffect {
 public:
  PwmDeadZone() : MuscleEffect(describe()) {}

 protected:
  bool fits(const MuscleModel& muscle) const override { return muscle.motor() != nullptr; }
  void change(const EffectSetting& setting, ModelDraft& draft, std::size_t muscle) const override {
    draft.robot.power_effects.push_back(std::make_shared<DeadZone>(muscle, setting["width"]));
  }
};

const EffectRegistration kRegistration(std::make_unique<PwmDeadZone>());

}  // namespace
}  // namespace anthrob
