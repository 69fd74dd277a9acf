#include "anthrob_sim/effects/friction_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "eyelet_friction";
  i.name = "Friction in eyelets";
  i.description =
      "The tendon rubs where an eyelet deflects it: tension before and after the eyelet differs by "
      "a factor that depends on the angle and not on the speed, and inverts with the direction of "
      "sliding. Added to the friction of the model, by the model's own law, or by the thesis's law "
      "with static over kinetic 1.25 if the model has none.";
  i.equation = "T_2 = T_1 exp(+-mu_total alpha), kinetic mu_total = mu_model + mu";
  i.source = "thesis (4.69)-(4.77), section 7.2.4";
  i.where = "MUSCLE/k | MUSCLE | all";
  i.seam = Seam::kPath;
  i.stage = Stage::kNumbers;
  i.dissipates = true;
  i.channels = {"force", "joint", "current"};
  i.parameters = friction_parameters(0.1);
  return i;
}

class EyeletFriction final : public SlidingFrictionEffect {
 public:
  EyeletFriction() : SlidingFrictionEffect(describe()) {}

 protected:
  bool fits(const PathObstacle& obstacle, bool inner) const override {
    return inner && !obstacle.surface;
  }
};

const EffectRegistration kRegistration(std::make_unique<EyeletFriction>());

}  // namespace
}  // namespace anthrob
