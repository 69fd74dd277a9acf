#include "anthrob_sim/effects/friction_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "wrap_friction";
  i.name = "Friction on wrapped surfaces";
  i.description =
      "The tendon rubs on the bone that it wraps around: capstan friction with a wrapping angle "
      "that depends on posture, and none while the tendon does not touch. It is not visible if "
      "surface and insertion move together. Added to the friction of the model, by the model's own "
      "law, or by the thesis's law with static over kinetic 1.25 if the model has none.";
  i.equation = "T_2 = T_1 exp(+-mu_total alpha(q)), kinetic mu_total = mu_model + mu";
  i.source = "thesis (4.69)-(4.77)";
  i.where = "MUSCLE/k | MUSCLE | all";
  i.seam = Seam::kPath;
  i.stage = Stage::kComponents;
  i.dissipates = true;
  i.channels = {"force", "joint", "current"};
  i.parameters = friction_parameters(0.15);
  return i;
}

class WrapFriction final : public SlidingFrictionEffect {
 public:
  WrapFriction() : SlidingFrictionEffect(describe()) {}

 protected:
  bool fits(const PathObstacle& obstacle, bool) const override {
    return obstacle.surface != nullptr;
  }
};

const EffectRegistration kRegistration(std::make_unique<WrapFriction>());

}  // namespace
}  // namespace anthrob
