#include <algorithm>

#include "anthrob_sim/effects/spring_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "see_mullins";
  i.name = "Mullins effect (softening of the spring)";
  i.description =
      "New rubber is stiffer the first time it is stretched: below the largest stretch so far it "
      "stays softer, beyond that it is like new. The first cycle differs from all others; rest "
      "does not restore the stiffness. The element is new at the start (reset, start of a "
      "replay).";
  i.equation = "f = f_model - softening k l_S (1 - (l_S / l_max)^2) for l_S < l_max";
  i.source = "Mullins 1969; Ogden, Roxburgh 1999 with a parabola for their error function";
  i.where = "MUSCLE | all";
  i.seam = Seam::kSpring;
  i.dissipates = true;
  i.slow = true;
  i.channels = {"force", "joint"};
  i.parameters = {
      {"softening", "1", "share of the stiffness lost near rest", 0.0, 0.25, {0.0, 0.9}}};
  return i;
}

class Mullins final : public ParallelForce {
 public:
  Mullins(std::shared_ptr<const SeriesElasticElement> inner, double stiffness, double step)
      : ParallelForce(std::move(inner), 2, step), stiffness_(stiffness) {}

 private:
  struct Own {
    double largest;  ///< stretch so far [m]
    double grown;    ///< by the last step [m]
  };
  void settle(double stretch, StateView own) const override { own.as<Own>() = {stretch, 0.0}; }
  double force(double, double to, StateView own) const override {
    Own& s = own.as<Own>();
    s.grown = std::max(0.0, to - s.largest);
    s.largest += s.grown;
    if (s.largest == 0.0) return 0.0;
    const double x = to / s.largest;
    return -stiffness_ * to * (1.0 - x * x);
  }
  double settled_force(double) const override { return 0.0; }
  /// What is missing of the element's energy.
  double energy(double stretch, StateView own) const override {
    const double largest = own.as<Own>().largest;
    if (largest == 0.0) return 0.0;
    const double x = stretch / largest;
    return -stiffness_ * stretch * stretch * (0.5 - 0.25 * x * x);
  }
  /// -d energy / d largest at the largest stretch.
  double heat(double, double, StateView own) const override {
    const Own& s = own.as<Own>();
    return 0.5 * stiffness_ * s.largest * s.grown / step();
  }

  double stiffness_;  ///< that is lost near rest [N/m]
};

class SeeMullins final : public SpringEffect {
 public:
  SeeMullins() : SpringEffect(describe()) {}

 protected:
  std::shared_ptr<const SeriesElasticElement> wrap(const EffectSetting& setting,
                                                   const MuscleModel& muscle,
                                                   double step) const override {
    return std::make_shared<Mullins>(
        muscle.spring, setting["softening"] * working_stiffness(*muscle.spring), step);
  }
};

const EffectRegistration kRegistration(std::make_unique<SeeMullins>());

}  // namespace
}  // namespace anthrob
