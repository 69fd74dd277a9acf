#include "anthrob_sim/effects/motor_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "gear_efficiency";
  i.name = "Gear losses";
  i.description =
      "The gear loses a different share of its torque than in the model; the gear law stays that "
      "of the model. The ratio of current to force differs between winding in and unwinding.";
  i.equation = "eta = (1 - loss) eta_model; tau_motor = tau / eta driving, tau eta driven";
  i.source = "thesis (4.13), Table 4.1";
  i.where = "MUSCLE | all";
  i.seam = Seam::kGear;
  i.stage = Stage::kNumbers;
  i.dissipates = true;
  i.channels = {"current", "velocity", "position"};
  i.parameters = {
      {"loss", "1", "missing share of the efficiency; < 0: a better gear", 0.0, 0.15, {-1.0, 0.9}}};
  return i;
}

class GearEfficiency final : public MotorEffect {
 public:
  GearEfficiency() : MotorEffect(describe()) {}

 protected:
  void change_motor(const EffectSetting& setting, const DcMotor& motor, double step,
                    MuscleModel& muscle) const override {
    const double efficiency = motor.gear()->efficiency() * (1.0 - setting["loss"]);
    if (efficiency > 1.0) setting.fail("loss", "a number for which the efficiency is at most 1");
    muscle.actuator = std::make_shared<DcMotor>(motor.parameters(),
                                                motor.gear()->with_efficiency(efficiency), step);
  }
};

const EffectRegistration kRegistration(std::make_unique<GearEfficiency>());

}  // namespace
}  // namespace anthrob
