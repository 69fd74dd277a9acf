#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "joint_effort_friction";
  i.name = "Friction in proportion to a drive's effort";
  i.description =
      "Screws, worms and gears rub in proportion to the effort that they pass on: the driven joint "
      "loses a share of it, in whatever direction it moves, and is held at rest by as much. While "
      "the motor drives, it looks like a smaller torque constant (effort_gain); while the load "
      "drives the motor, like a larger one.";
  i.equation = "|tau| = share |effort|";
  i.source = "Coulomb friction of flanks; Olsson et al. 1998, Friction models and compensation";
  i.where = "JOINT (driven)";
  i.seam = Seam::kJoints;
  i.stage = Stage::kSkeleton;
  i.dissipates = true;
  i.channels = {"joint", "effort"};
  i.parameters = {{"share", "1", "of the effort that is lost", 0.0, 0.1, {0.0, 0.95}}};
  return i;
}

class JointEffortFriction final : public JointEffect {
 public:
  JointEffortFriction() : JointEffect(describe()) {}

 protected:
  bool fits(const JointModel& joint) const override { return joint.driven; }
  void change(const EffectSetting& setting, ModelDraft&, JointModel& joint) const override {
    joint.friction.effort_share += setting["share"];
  }
};

const EffectRegistration kRegistration(std::make_unique<JointEffortFriction>());

}  // namespace
}  // namespace anthrob
