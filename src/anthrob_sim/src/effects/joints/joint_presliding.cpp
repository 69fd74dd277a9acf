#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "joint_presliding";
  i.name = "Dry joint friction that bends before it slides (Dahl)";
  i.description =
      "Bearings, seals and gears bend under friction before they slide: after a reversal, friction "
      "depends on the way since then and forms a small hysteresis loop. In one direction it "
      "becomes the dry friction of joint_coulomb, from which it cannot be distinguished where all "
      "motions are long compared to the distance. Added to the friction of the model.";
  i.equation = "tau = -torque z, dz/dq = (1 - sign(dq/dt) z) / distance";
  i.source = "Dahl 1968, A solid friction model";
  i.where = "JOINT (hinges and slides)";
  i.seam = Seam::kJoints;
  i.stage = Stage::kSkeleton;
  i.dissipates = true;
  i.limit = "joint_coulomb";
  i.channels = {"joint", "force"};
  i.parameters = {
      {"torque", "Nm", "while sliding", 0.0, 0.1, {0.0, 1e6}},
      {"distance",
       "rad",
       "way after which 63 % of friction is back",
       0.01,
       0.01,
       {1e-5, 1.0},
       EffectParameter::kShape},
  };
  return i;
}

class JointPresliding final : public JointEffect {
 public:
  JointPresliding() : JointEffect(describe()) {}

 protected:
  bool fits(const JointModel& joint) const override { return joint.type != JointType::kBall; }
  void change(const EffectSetting& setting, ModelDraft&, JointModel& joint) const override {
    BristleModel bristles;
    bristles.torque = setting["torque"];
    bristles.distance = setting["distance"];
    joint.friction.bristles.push_back(bristles);
  }
};

const EffectRegistration kRegistration(std::make_unique<JointPresliding>());

}  // namespace
}  // namespace anthrob
