#include "anthrob_sim/effects/motor_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "gear_efficiency";
  i.name = "Losses of the gear";
  i.description =
      "The gear loses another share of its torque than the model says, by the model's own gear "
      "law: the ratio of current to force differs between winding in and running down.";
  i.equation = "eta = (1 - loss) eta_model; tau_motor = tau / eta driving, tau eta driven";
  i.source = "thesis (4.13), Table 4.1";
  i.where = "MUSCLE | all";
  i.seam = Seam::kGear;
  i.stage = Stage::kNumbers;
  i.dissipates = true;
  i.channels = {"current", "velocity", "position"};
  i.parameters = {{"loss",
                   "1",
                   "share of the efficiency that is missing; < 0: a better gear",
                   0.0,
                   0.15,
                   {-1.0, 0.9}}};
  return i;
}

class GearEfficiency final : public MotorEffect {
 public:
  GearEfficiency() : MotorEffect(describe()) {}

 protected:
  void change_motor(const EffectSetting& setting, const DcMotor& motor, double step,
                    MuscleModel& muscle) const override {
    const double efficiency = motor.gear()->efficiency() * (1.0 - setting["loss"]);
    if (efficiency > 1.0) setting.fail("loss", "a number that leaves the efficiency at most 1");
    muscle.actuator = std::make_shared<DcMotor>(motor.parameters(),
                                                motor.gear()->with_efficiency(efficiency), step);
  }
};

const EffectRegistration kRegistration(std::make_unique<GearEfficiency>());

}  // namespace
}  // namespace anthrob
