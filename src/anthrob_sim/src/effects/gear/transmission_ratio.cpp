#include "anthrob_sim/effects/motor_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "transmission_ratio";
  i.name = "Error of a drive's transmission ratio";
  i.description =
      "The motor of a drive turns more often per turn of its joint than the model says: a pulley "
      "of another size, or a slipped tooth count.";
  i.equation = "q_motor = (1 + error) ratio q";
  i.source = "own model, kinematics";
  i.where = "DRIVE";
  i.seam = Seam::kGear;
  i.stage = Stage::kNumbers;
  i.channels = {"position", "joint", "velocity", "current"};
  i.parameters = {{"error", "1", "of the ratio, relative", 0.0, 0.02, {-0.5, 1.0}}};
  return i;
}

class TransmissionRatio final : public MotorEffect {
 public:
  TransmissionRatio() : MotorEffect(describe()) {}

 protected:
  bool fits(const MuscleModel& muscle) const override { return muscle.is_drive(); }
  void change_motor(const EffectSetting& setting, const DcMotor& motor, double step,
                    MuscleModel& drive) const override {
    DcMotor::Parameters p = motor.parameters();
    p.spindle_radius /= 1.0 + setting["error"];
    drive.actuator = std::make_shared<DcMotor>(p, motor.gear(), step);
  }
};

const EffectRegistration kRegistration(std::make_unique<TransmissionRatio>());

}  // namespace
}  // namespace anthrob
