#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "joint_viscous";
  i.name = "Viscous joint friction";
  i.description =
      "Grease and seals resist a joint in proportion to its speed. Added to the friction of the "
      "model. Unmodelled dry friction looks similar over a narrow range of speeds.";
  i.equation = "tau = -damping dq/dt";
  i.source = "thesis (3.6), last term";
  i.where = "JOINT";
  i.seam = Seam::kJoints;
  i.stage = Stage::kSkeleton;
  i.dissipates = true;
  i.channels = {"joint", "force"};
  i.parameters = {{"damping", "Nms/rad", "torque per speed", 0.0, 0.05, {0.0, 1e6}}};
  return i;
}

class JointViscous final : public JointEffect {
 public:
  JointViscous() : JointEffect(describe()) {}

 protected:
  void change(const EffectSetting& setting, ModelDraft&, JointModel& joint) const override {
    joint.friction.viscous += setting["damping"];
  }
};

const EffectRegistration kRegistration(std::make_unique<JointViscous>());

}  // namespace
}  // namespace anthrob
