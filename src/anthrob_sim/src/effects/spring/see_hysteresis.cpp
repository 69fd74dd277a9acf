#include <cmath>

#include "anthrob_sim/effects/spring_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "see_hysteresis";
  i.name = "Rate-independent hysteresis of the spring";
  i.description =
      "Filler and friction inside the rubber resist any change of length: a loop of force over "
      "stretch that, unlike a viscous one, does not shrink at low rate, and a small loop at every "
      "reversal. Bouc-Wen model with exponent 1.";
  i.equation =
      "f = f_model + F z, dz = (1 - sign(dl_S) z) dl_S / (turn l_0), F = share f_rest(0.3 l_0)";
  i.source = "Bouc 1967, Wen 1976";
  i.where = "MUSCLE | all";
  i.seam = Seam::kSpring;
  i.dissipates = true;
  i.channels = {"force", "joint"};
  i.parameters = {
      {"share", "1", "of the static force at a strain of 30 %", 0.0, 0.1, {0.0, 1.0}},
      {"turn",
       "1",
       "strain after a reversal at which 63 % of the change has built up",
       0.05,
       0.05,
       {0.001, 1.0},
       EffectParameter::kShape},
  };
  return i;
}

class BoucWen final : public ParallelForce {
 public:
  BoucWen(std::shared_ptr<const SeriesElasticElement> inner, double force, double turn, double step)
      : ParallelForce(std::move(inner), 1, step), force_(force), turn_(turn) {}

 private:
  void settle(double, StateView own) const override { own[0] = 0.0; }
  double force(double from, double to, StateView own) const override {
    const double side = to > from ? 1.0 : -1.0;
    own[0] = side + (own[0] - side) * std::exp(-std::abs(to - from) / turn_);
    return force_ * own[0];
  }
  double settled_force(double) const override { return 0.0; }
  double energy(double, StateView own) const override {
    return 0.5 * force_ * turn_ * own[0] * own[0];
  }
  double heat(double, double rate, StateView own) const override {
    return force_ * own[0] * own[0] * std::abs(rate);
  }

  double force_, turn_;
};

class SeeHysteresis final : public SpringEffect {
 public:
  SeeHysteresis() : SpringEffect(describe()) {}

 protected:
  std::shared_ptr<const SeriesElasticElement> wrap(const EffectSetting& setting,
                                                   const MuscleModel& muscle,
                                                   double step) const override {
    const double stretch = working_stretch(*muscle.spring);
    return std::make_shared<BoucWen>(muscle.spring,
                                     setting["share"] * muscle.spring->relaxed_tension(stretch),
                                     setting["turn"] * stretch / 0.3, step);
  }
};

const EffectRegistration kRegistration(std::make_unique<SeeHysteresis>());

}  // namespace
}  // namespace anthrob
