#include "anthrob_sim/effects/motor_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "motor_friction";
  i.name = "Dry friction of a motor";
  i.description =
      "Brushes, bearings and the gear's first stage rub whatever the load is: more dry friction at "
      "the shaft of the motor than in the model. It takes the same current at every speed and "
      "holds the motor where the rest is less.";
  i.equation = "|tau_shaft| = friction_torque_model + torque, against motion; at rest any up to it";
  i.source = "thesis (4.2); no-load currents of data sheets";
  i.where = "MUSCLE | all";
  i.seam = Seam::kMotor;
  i.stage = Stage::kNumbers;
  i.dissipates = true;
  i.channels = {"current", "velocity", "position"};
  i.parameters = {{"torque", "Nm", "at the motor shaft", 0.0, 5e-4, {0.0, 1.0}}};
  return i;
}

class MotorFriction final : public MotorEffect {
 public:
  MotorFriction() : MotorEffect(describe()) {}

  /// Of one muscle or drive, typically as large a share of the stall torque as in the thesis's.
  std::vector<EffectParameter> parameters_at(const RobotModel& robot,
                                             const std::string& place) const override {
    constexpr double kShareOfStall = 0.003;
    std::vector<EffectParameter> list = info().parameters;
    const int muscle = robot.find_muscle(place);
    if (muscle < 0) return list;
    const auto* motor = dynamic_cast<const DcMotor*>(robot.muscles[muscle].actuator.get());
    if (!motor) return list;
    const DcMotor::Parameters& p = motor->parameters();
    list[0].typical = kShareOfStall * p.torque_constant * p.voltage_limit / p.resistance;
    return list;
  }

 protected:
  void change_motor(const EffectSetting& setting, const DcMotor& motor, double step,
                    MuscleModel& muscle) const override {
    DcMotor::Parameters p = motor.parameters();
    p.friction_torque += setting["torque"];
    muscle.actuator = std::make_shared<DcMotor>(p, motor.gear(), step);
  }
};

const EffectRegistration kRegistration(std::make_unique<MotorFriction>());

}  // namespace
}  // namespace anthrob
