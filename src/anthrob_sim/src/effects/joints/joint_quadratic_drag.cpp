#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "joint_quadratic_drag";
  i.name = "Drag of air or liquid on a joint";
  i.description =
      "Air or a liquid resists a joint in proportion to the square of its speed: a fan on a shaft, "
      "a limb in water, a churned oil bath. Over a narrow range of speeds it cannot be "
      "distinguished from viscous friction together with dry friction.";
  i.equation = "tau = -drag |dq/dt| dq/dt";
  i.source = "drag at a high Reynolds number, Newton's resistance law";
  i.where = "JOINT (hinges and slides)";
  i.seam = Seam::kJoints;
  i.stage = Stage::kSkeleton;
  i.dissipates = true;
  i.channels = {"joint", "force"};
  i.parameters = {{"drag", "Nms2/rad2", "torque per square of speed", 0.0, 0.02, {0.0, 1e6}}};
  return i;
}

class JointQuadraticDrag final : public JointEffect {
 public:
  JointQuadraticDrag() : JointEffect(describe()) {}

 protected:
  bool fits(const JointModel& joint) const override { return joint.type != JointType::kBall; }
  void change(const EffectSetting& setting, ModelDraft&, JointModel& joint) const override {
    joint.friction.quadratic += setting["drag"];
  }
};

const EffectRegistration kRegistration(std::make_unique<JointQuadraticDrag>());

}  // namespace
}  // namespace anthrob
