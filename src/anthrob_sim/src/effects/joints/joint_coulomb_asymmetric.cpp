#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "joint_coulomb_asymmetric";
  i.name = "Dry joint friction that differs by direction";
  i.description =
      "A preloaded screw or seal rubs more in one direction than in the other. Added to what the "
      "model has. It cannot be told from symmetric friction beside a constant torque "
      "(joint_offset_torque) that is less than it, neither in motion nor at rest: only what takes "
      "that torque away can tell, an amplifier that is off or the joint turned over.";
  i.equation = "tau = -forward if dq/dt > 0, +backward if dq/dt < 0, holds at rest up to both";
  i.source = "Janot, Gautier, Brunot, EMPS benchmark 2019";
  i.where = "JOINT";
  i.seam = Seam::kJoints;
  i.stage = Stage::kSkeleton;
  i.dissipates = true;
  i.channels = {"joint", "force"};
  i.parameters = {
      {"forward", "Nm", "more friction while moving forward", 0.0, 0.1, {0.0, 10.0}},
      {"backward", "Nm", "more friction while moving backward", 0.0, 0.05, {0.0, 10.0}},
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
