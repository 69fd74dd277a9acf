#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "joint_lugre";
  i.name = "Dry joint friction that bends, breaks away and slides (LuGre)";
  i.description =
      "As joint_presliding, but friction is larger at rest and falls as the joint begins to slide "
      "(Stribeck), and the bristles that bend have a damping of their own. The damping falls with "
      "speed, so that the law never creates energy; it hardly shows in recordings, so state it if "
      "you know it. Added to the friction of the model.";
  i.equation =
      "tau = -torque (z + c dz/dt), dz/dt = (v - |v| z / s) / distance, s = 1 + (static_ratio - 1) "
      "exp(-(v / stribeck_velocity)^2), c = damping / (1 + damping |v| / distance)";
  i.source =
      "Canudas de Wit, Olsson, Astrom, Lischinsky 1995, A new model for control of systems with "
      "friction; damping as Olsson 1996, Control systems with friction";
  i.where = "JOINT (hinges and slides)";
  i.seam = Seam::kJoints;
  i.stage = Stage::kSkeleton;
  i.dissipates = true;
  i.limit = "joint_presliding";
  i.channels = {"joint", "force"};
  i.parameters = {
      {"torque", "Nm", "while sliding fast", 0.0, 0.1, {0.0, 1e6}},
      {"distance",
       "rad",
       "way after which 63 % of friction is back",
       0.01,
       0.01,
       {1e-5, 1.0},
       EffectParameter::kShape},
      {"static_ratio",
       "1",
       "friction at rest over that while sliding fast",
       1.0,
       1.3,
       {1.0, 3.0},
       EffectParameter::kShape},
      {"stribeck_velocity",
       "rad/s",
       "at which friction has fallen by 63 % of the difference",
       0.05,
       0.05,
       {0.001, 1.0},
       EffectParameter::kShape},
      {"damping",
       "s",
       "of the bristles at rest, over their stiffness",
       0.01,
       0.01,
       {0.0, 1.0},
       EffectParameter::kGiven},
  };
  return i;
}

class JointLugre final : public JointEffect {
 public:
  JointLugre() : JointEffect(describe()) {}

 protected:
  bool fits(const JointModel& joint) const override { return joint.type != JointType::kBall; }
  void change(const EffectSetting& setting, ModelDraft&, JointModel& joint) const override {
    BristleModel bristles;
    bristles.torque = setting["torque"];
    bristles.distance = setting["distance"];
    bristles.static_ratio = setting["static_ratio"];
    bristles.stribeck_velocity = setting["stribeck_velocity"];
    bristles.damping = setting["damping"];
    joint.friction.bristles.push_back(bristles);
  }
};

const EffectRegistration kRegistration(std::make_unique<JointLugre>());

}  // namespace
}  // namespace anthrob
