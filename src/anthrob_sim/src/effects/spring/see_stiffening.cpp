#include <cmath>

#include "anthrob_sim/effects/spring_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "see_stiffening";
  i.name = "Strain stiffening of the spring";
  i.description =
      "The spring's modulus depends on its strain, while the model's is constant: rubber softens "
      "as it begins to stretch and hardens as its chains straighten. The relaxed tangent modulus "
      "grows in proportion to the stress, or falls if the number is negative. Elastic, without "
      "loss.";
  i.equation = "f = f_model + k l_0 ((exp(a e) - 1) / a - e), a = stiffening, e = l_S / l_0";
  i.source = "Fung 1967, Elasticity of soft tissues in simple elongation: d f / d e = k l_0 + a f";
  i.where = "MUSCLE | all";
  i.seam = Seam::kSpring;
  i.channels = {"force", "joint"};
  i.parameters = {{"stiffening",
                   "1",
                   "relative growth of the modulus per strain; < 0: it falls",
                   0.0,
                   0.5,
                   {-3.0, 5.0}}};
  return i;
}

class Stiffening final : public ParallelForce {
 public:
  Stiffening(std::shared_ptr<const SeriesElasticElement> inner, double stiffness, double length,
             double rate, double step)
      : ParallelForce(std::move(inner), 0, step),
        stiffness_(stiffness),
        length_(length),
        rate_(rate) {}

 private:
  void settle(double, StateView) const override {}
  double force(double, double to, StateView) const override { return settled_force(to); }
  double settled_force(double stretch) const override {
    return stiffness_ * length_ * beyond_linear(rate_ * stretch / length_) / rate_;
  }
  double energy(double stretch, StateView) const override {
    const double x = rate_ * stretch / length_;
    return stiffness_ * std::pow(length_ / rate_, 2) * (beyond_linear(x) - 0.5 * x * x);
  }
  double heat(double, double, StateView) const override { return 0.0; }

  /// exp(x) - 1 - x
  static double beyond_linear(double x) { return std::expm1(x) - x; }

  double stiffness_;  ///< at rest [N/m]
  double length_;     ///< l_0 [m]
  double rate_;       ///< of stiffening [1]
};

class SeeStiffening final : public SpringEffect {
 public:
  SeeStiffening() : SpringEffect(describe()) {}

 protected:
  std::shared_ptr<const SeriesElasticElement> wrap(const EffectSetting& setting,
                                                   const MuscleModel& muscle,
                                                   double step) const override {
    return std::make_shared<Stiffening>(muscle.spring, working_stiffness(*muscle.spring),
                                        working_stretch(*muscle.spring) / 0.3,
                                        setting["stiffening"], step);
  }
};

const EffectRegistration kRegistration(std::make_unique<SeeStiffening>());

}  // namespace
}  // namespace anthrob
