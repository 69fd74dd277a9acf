#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "joint_load_friction";
  i.name = "Load-dependent joint friction";
  i.description =
      "A bearing or a guide rubs under the force that it carries: weight, inertia and the pull of "
      "muscles. A hinge rubs at the radius of its shaft; on a slide only the force across its axis "
      "counts, and there is no radius. Without gravity and muscles a joint carries next to "
      "nothing: "
      "see joint_effort_friction. The force of the previous step is used.";
  i.equation = "|tau| = mu radius |N|, on a slide |F| = mu |N|";
  i.source = "Coulomb friction of a plain bearing, of a guide";
  i.where = "JOINT (hinges and slides)";
  i.seam = Seam::kJoints;
  i.stage = Stage::kSkeleton;
  i.dissipates = true;
  i.channels = {"joint", "force"};
  i.parameters = {
      {"mu", "1", "coefficient of friction", 0.0, 0.15, {0.0, 1.0}},
      {"radius", "m", "of the shaft", 0.01, 0.01, {0.0005, 0.2}, EffectParameter::kGiven},
  };
  return i;
}

bool slides(const JointModel& joint) {
  return joint.type == JointType::kPrismatic;
}

class JointLoadFriction final : public JointEffect {
 public:
  JointLoadFriction() : JointEffect(describe()) {}

  std::vector<EffectParameter> parameters_at(const RobotModel& robot,
                                             const std::string& place) const override {
    std::vector<EffectParameter> list = JointEffect::parameters_at(robot, place);
    const int joint = robot.skeleton->find_joint(place);
    if (joint >= 0 && slides(robot.skeleton->joints[static_cast<std::size_t>(joint)])) {
      list.resize(1);
    }
    return list;
  }

 protected:
  bool fits(const JointModel& joint) const override { return joint.type != JointType::kBall; }
  void change(const EffectSetting& setting, ModelDraft&, JointModel& joint) const override {
    joint.friction.load_radius += setting["mu"] * (slides(joint) ? 1.0 : setting["radius"]);
  }
};

const EffectRegistration kRegistration(std::make_unique<JointLoadFriction>());

}  // namespace
}  // namespace anthrob
