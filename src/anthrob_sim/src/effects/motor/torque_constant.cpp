#include "anthrob_sim/effects/motor_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "torque_constant";
  i.name = "Error of a motor's torque constant";
  i.description =
      "The motor of a drive makes another torque from its current than the model says, and the "
      "same share more voltage from its speed: a magnet's strength is within 10 % at best, and "
      "falls with its temperature.";
  i.equation = "K_T = (1 + error) K_T,model, K_E = (1 + error) K_E,model";
  i.source = "thesis (4.2), (4.3); data sheets of motors";
  i.where = "DRIVE";
  i.seam = Seam::kMotor;
  i.stage = Stage::kNumbers;
  i.channels = {"current", "velocity", "position", "joint"};
  i.parameters = {{"error", "1", "of both constants, relative", 0.0, 0.1, {-0.5, 1.0}}};
  return i;
}

class TorqueConstant final : public MotorEffect {
 public:
  TorqueConstant() : MotorEffect(describe()) {}

 protected:
  bool fits(const MuscleModel& muscle) const override { return muscle.is_drive(); }
  void change_motor(const EffectSetting& setting, const DcMotor& motor, double step,
                    MuscleModel& drive) const override {
    DcMotor::Parameters p = motor.parameters();
    p.torque_constant *= 1.0 + setting["error"];
    p.back_emf_constant *= 1.0 + setting["error"];
    drive.actuator = std::make_shared<DcMotor>(p, motor.gear(), step);
  }
};

const EffectRegistration kRegistration(std::make_unique<TorqueConstant>());

}  // namespace
}  // namespace anthrob
