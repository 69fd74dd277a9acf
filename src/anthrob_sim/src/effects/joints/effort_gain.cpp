#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "effort_gain";
  i.name = "Error of a drive's torque constant";
  i.description =
      "The effort of a driven joint is seldom measured: it is a current times a torque constant, "
      "or a voltage times a gain, and that constant is wrong. All that the model knows in Nm or N "
      "must be right for it to be seen: if inertia and friction are off by the same factor, the "
      "motion is the same.";
  i.equation = "tau = gain effort";
  i.source = "known; Janot, Gautier, Brunot, EMPS benchmark 2019, on drive gains";
  i.where = "JOINT (driven)";
  i.seam = Seam::kJoints;
  i.stage = Stage::kSkeleton;
  i.channels = {"joint", "effort"};
  i.parameters = {{"gain", "1", "effort that acts over the recorded one", 1.0, 1.1, {0.1, 10.0}}};
  return i;
}

class EffortGain final : public JointEffect {
 public:
  EffortGain() : JointEffect(describe()) {}

 protected:
  bool fits(const JointModel& joint) const override { return joint.driven; }
  void change(const EffectSetting& setting, ModelDraft&, JointModel& joint) const override {
    joint.effort_gain *= setting["gain"];
  }
};

const EffectRegistration kRegistration(std::make_unique<EffortGain>());

}  // namespace
}  // namespace anthrob
