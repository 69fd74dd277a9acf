#include "anthrob_sim/effects/spring_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "see_toe";
  i.name = "Soft toe region of the spring";
  i.description =
      "A ring bends into its slot before it stretches: at low strain it is softer than the rubber "
      "alone; at larger strain the difference vanishes. Reversible, without loss.";
  i.equation = "f = f_model - softness k l_S (1 - l_S / (strain l_0))^2 for l_S < strain l_0";
  i.source = "thesis, section 7.2: rings of two strands, strain below 0.57";
  i.where = "MUSCLE | all";
  i.seam = Seam::kSpring;
  i.channels = {"force", "joint"};
  i.parameters = {
      {"softness", "1", "missing share of the stiffness at rest", 0.0, 0.3, {0.0, 0.95}},
      {"strain",
       "1",
       "at which the toe region ends",
       0.57,
       0.57,
       {0.05, 2.0},
       EffectParameter::kShape},
  };
  return i;
}

class Toe final : public ParallelForce {
 public:
  Toe(std::shared_ptr<const SeriesElasticElement> inner, double stiffness, double end, double step)
      : ParallelForce(std::move(inner), 0, step), stiffness_(stiffness), end_(end) {}

 private:
  void settle(double, StateView) const override {}
  double force(double, double to, StateView) const override { return settled_force(to); }
  double settled_force(double stretch) const override {
    const double left = 1.0 - stretch / end_;
    return left > 0.0 ? -stiffness_ * stretch * left * left : 0.0;
  }
  double energy(double stretch, StateView) const override {
    const double x = stretch < end_ ? stretch / end_ : 1.0;
    return -stiffness_ * end_ * end_ * x * x * (0.5 - x * (2.0 / 3.0 - 0.25 * x));
  }
  double heat(double, double, StateView) const override { return 0.0; }

  double stiffness_;  ///< that is missing at rest [N/m]
  double end_;        ///< stretch at which the toe ends [m]
};

class SeeToe final : public SpringEffect {
 public:
  SeeToe() : SpringEffect(describe()) {}

 protected:
  std::shared_ptr<const SeriesElasticElement> wrap(const EffectSetting& setting,
                                                   const MuscleModel& muscle,
                                                   double step) const override {
    return std::make_shared<Toe>(muscle.spring,
                                 setting["softness"] * working_stiffness(*muscle.spring),
                                 setting["strain"] * working_stretch(*muscle.spring) / 0.3, step);
  }
};

const EffectRegistration kRegistration(std::make_unique<SeeToe>());

}  // namespace
}  // namespace anthrob
