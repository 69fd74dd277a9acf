#include <cmath>

#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "joint_coulomb";
  i.name = "Dry (Coulomb) joint friction";
  i.description =
      "Bearings and seals resist with a torque that hardly depends on speed, and hold the joint at "
      "rest up to a somewhat higher torque: it sticks and slips at low speed. Added to the "
      "friction of the model. Where both are larger at rest, their Stribeck velocities are "
      "averaged, weighted by how much larger. Isotropic for ball joints.";
  i.equation = "|tau| = torque (1 + (static_ratio - 1) exp(-|dq/dt| / stribeck_velocity))";
  i.source = "thesis (3.6); Stribeck 1902";
  i.where = "JOINT";
  i.seam = Seam::kJoints;
  i.stage = Stage::kSkeleton;
  i.dissipates = true;
  i.channels = {"joint", "force"};
  i.parameters = {
      {"torque", "Nm", "while sliding fast, F_c", 0.0, 0.1, {0.0, 1e6}},
      {"static_ratio",
       "1",
       "friction at rest over that, F_s / F_c",
       1.0,
       1.3,
       {1.0, 3.0},
       EffectParameter::kShape},
      {"stribeck_velocity", "rad/s", "v_s", 0.05, 0.05, {0.001, 1.0}, EffectParameter::kShape},
  };
  return i;
}

class JointCoulomb final : public JointEffect {
 public:
  JointCoulomb() : JointEffect(describe()) {}

 protected:
  void change(const EffectSetting& setting, ModelDraft&, JointModel& joint) const override {
    JointFrictionModel& friction = joint.friction;
    const double torque = setting["torque"], at_rest = torque * setting["static_ratio"];
    const double velocity = setting["stribeck_velocity"];
    const double more = at_rest - torque;
    const double models = std::abs(friction.static_torque - friction.kinetic_torque);
    friction.kinetic_torque += torque;
    friction.static_torque += at_rest;
    // A joint has one Stribeck curve. Weighted, so that a vanishing torque changes nothing.
    if (models == 0.0) {
      friction.stribeck_velocity = velocity;
    } else {
      friction.stribeck_velocity +=
          (velocity - friction.stribeck_velocity) * more / (models + more);
    }
  }
};

const EffectRegistration kRegistration(std::make_unique<JointCoulomb>());

}  // namespace
}  // namespace anthrob
