#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "transmission_elasticity";
  i.name = "Elastic transmission of a drive";
  i.description =
      "The joint lags behind the motor of its drive in proportion to the torque, in addition to "
      "what the model's transmission gives; together they vibrate. Shafts, belts and harmonic "
      "drives do.";
  i.equation = "q_motor / ratio - q = (1 / k_model + compliance) tau";
  i.source = "Spong 1987, Modeling and control of elastic joint robots";
  i.where = "DRIVE";
  i.seam = Seam::kGear;
  i.stage = Stage::kParts;
  i.channels = {"position", "joint"};
  i.parameters = {
      {"compliance", "rad/Nm", "angle at the joint per torque", 0.0, 0.005, {0.0, 10.0}}};
  return i;
}

class TransmissionElasticity final : public MuscleEffect {
 public:
  TransmissionElasticity() : MuscleEffect(describe()) {}

  /// In metres per newton where the joint slides.
  std::vector<EffectParameter> parameters_at(const RobotModel& robot,
                                             const std::string& place) const override {
    constexpr double kPerNewton = 1e-3;
    std::vector<EffectParameter> list = info().parameters;
    const int muscle = robot.find_muscle(place);
    if (muscle < 0 || !robot.muscles[muscle].is_drive()) return list;
    const int joint = robot.muscles[muscle].path->joint();
    if (robot.skeleton->joints[joint].type != JointType::kPrismatic) return list;
    list[0].unit = "m/N";
    list[0].typical *= kPerNewton;
    list[0].bounds.hi *= kPerNewton;
    return list;
  }

 protected:
  bool fits(const MuscleModel& muscle) const override { return muscle.is_drive(); }
  void change(const EffectSetting& setting, ModelDraft& draft, std::size_t index) const override {
    MuscleModel& drive = draft.robot.muscles[index];
    Transmission softer = *drive.transmission;
    softer.stiffness = 1.0 / (1.0 / softer.stiffness + setting["compliance"]);
    drive.transmit(softer);
  }
};

const EffectRegistration kRegistration(std::make_unique<TransmissionElasticity>());

}  // namespace
}  // namespace anthrob
