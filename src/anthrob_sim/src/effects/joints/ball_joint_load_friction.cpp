#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "ball_joint_load_friction";
  i.name = "Load-dependent ball joint friction";
  i.description =
      "The ball rubs in its socket under the force that the joint carries, which is mostly the sum "
      "of the muscle forces: in one and the same posture, friction grows with co-contraction. The "
      "force of the previous step is used.";
  i.equation = "|tau| = mu radius |N|";
  i.source = "Coulomb friction of a ball in a socket, contact opposite to the load";
  i.where = "JOINT (ball joints)";
  i.seam = Seam::kJoints;
  i.stage = Stage::kSkeleton;
  i.dissipates = true;
  i.channels = {"joint", "force"};
  i.parameters = {
      {"mu", "1", "coefficient of friction", 0.0, 0.15, {0.0, 1.0}},
      {"radius", "m", "of the ball", 0.015, 0.015, {0.001, 0.1}, EffectParameter::kGiven},
  };
  return i;
}

class BallJointLoadFriction final : public JointEffect {
 public:
  BallJointLoadFriction() : JointEffect(describe()) {}

 protected:
  bool fits(const JointModel& joint) const override { return joint.type == JointType::kBall; }
  void change(const EffectSetting& setting, ModelDraft&, JointModel& joint) const override {
    joint.friction.load_radius += setting["mu"] * setting["radius"];
  }
};

const EffectRegistration kRegistration(std::make_unique<BallJointLoadFriction>());

}  // namespace
}  // namespace anthrob
