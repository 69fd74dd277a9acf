#include "anthrob_sim/effects/motor_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "series_resistance";
  i.name = "Resistance in series with a motor";
  i.description =
      "Bridge, cables and plugs have a resistance: voltage and speed are lost in proportion "
      "to current. Added to the power stage's resistance in the model.";
  i.equation = "V_motor = V - resistance i";
  i.source = "thesis, section 7.3.2 (0.12 ohm)";
  i.where = "MUSCLE | all";
  i.seam = Seam::kPowerStage;
  i.stage = Stage::kNumbers;
  i.dissipates = true;
  i.channels = {"current", "velocity"};
  i.parameters = {{"resistance", "ohm", "of bridge and cables", 0.0, 0.2, {0.0, 10.0}}};
  return i;
}

class SeriesResistance final : public MotorEffect {
 public:
  SeriesResistance() : MotorEffect(describe()) {}

 protected:
  void change_motor(const EffectSetting& setting, const DcMotor& motor, double step,
                    MuscleModel& muscle) const override {
    DcMotor::Parameters p = motor.parameters();
    p.resistance += setting["resistance"];
    muscle.actuator = std::make_shared<DcMotor>(p, motor.gear(), step);
  }
};

const EffectRegistration kRegistration(std::make_unique<SeriesResistance>());

}  // namespace
}  // namespace anthrob
