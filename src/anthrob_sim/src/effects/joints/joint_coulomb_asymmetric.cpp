#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "joint_coulomb_asymmetric";
  i.name = "Direction-dependent dry joint friction";
  i.description =
      "A preloaded screw or seal rubs more in one direction than in the other. Added to the "
      "friction of the model. It cannot be distinguished from symmetric friction together with a "
      "smaller constant torque (joint_offset_torque), neither in motion nor at rest. To "
      "distinguish them, remove the constant torque: switch the amplifier off, or turn the joint "
      "over.";
  i.equation = "tau = -forward if dq/dt > 0, +backward if dq/dt < 0, holds at rest up to both";
  i.source = "Janot, Gautier, Brunot, EMPS benchmark 2019";
  i.where = "JOINT (hinges and slides)";
  i.seam = Seam::kJoints;
  i.stage = Stage::kSkeleton;
  i.dissipates = true;
  i.channels = {"joint", "force"};
  i.parameters = {
      {"forward", "Nm", "more friction while moving forward", 0.0, 0.1, {0.0, 1e6}},
      {"backward", "Nm", "more friction while moving backward", 0.0, 0.05, {0.0, 1e6}},
  };
  return i;
}

class JointCoulombAsymmetric final : public JointEffect {
 public:
  JointCoulombAsymmetric() : JointEffect(describe()) {}

 protected:
  bool fits(const JointModel& joint) const override { return joint.type != JointType::kBall; }
  void change(const EffectSetting& setting, ModelDraft&, JointModel& joint) const override {
    joint.friction.forward += setting["forward"];
    joint.friction.backward += setting["backward"];
  }
};

const EffectRegistration kRegistration(std::make_unique<JointCoulombAsymmetric>());

}  // namespace
}  // namespace anthrob
