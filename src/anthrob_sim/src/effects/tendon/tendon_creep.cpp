#include <cmath>

#include "anthrob_sim/effects/spring_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "tendon_creep";
  i.name = "Tendon creep";
  i.description =
      "Under load the tendon's fibres slip: it gets longer with the logarithm of time, by a few "
      "tenths of a per cent over minutes, and does not recover. The tendon is new at the start "
      "(reset, start of a replay). Strain hardening extends the law to changing loads.";
  i.equation =
      "dL/dt = rate l_T0 f / onset exp(-dL / (rate l_T0 f)); for constant f: dL = rate l_T0 f "
      "log(1 + t / onset)";
  i.source = "logarithmic creep of polymer ropes; known: 0.1-2 %";
  i.where = "MUSCLE | all";
  i.seam = Seam::kTendon;
  i.dissipates = true;
  i.slow = true;
  i.channels = {"force", "joint", "position"};
  i.parameters = {
      {"rate", "1/N", "strain per force and e-fold of time", 0.0, 3e-5, {0.0, 0.003}},
      {"onset",
       "s",
       "after which the logarithm begins",
       1.0,
       1.0,
       {0.01, 100.0},
       EffectParameter::kShape},
  };
  return i;
}

class CreepingTendon final : public SpringWrapper {
 public:
  CreepingTendon(std::shared_ptr<const SeriesElasticElement> inner, double rate, double onset,
                 double step)
      : SpringWrapper(std::move(inner), state_size_of<Own>()),
        rate_(rate),
        onset_(onset),
        step_(step) {}

  void relax(double expansion, StateView state) const override {
    inner().relax(expansion, inner_state(state));
    state.as<Own>() = {0.0, 0.0, 0.0, 0.0};
  }
  double advance(double expansion, StateView state) const override {
    Own& s = state.as<Own>();
    s.moved = s.growth;
    const double tension = inner().advance(expansion - s.creep, inner_state(state));
    s.growth = 0.0;
    s.heat = 0.0;
    const double reach = rate_ * tension;
    if (reach > 0.0) {
      // Exact for the tension of this step.
      s.growth = reach * std::log1p(step_ / onset_ * std::exp(-s.creep / reach));
      s.creep += s.growth;
      s.heat = tension * s.moved / step_;
    }
    return tension;
  }
  double relaxed_tension(double expansion) const override {
    return inner().relaxed_tension(expansion);
  }
  double relaxed_expansion(double tension) const override {
    return inner().relaxed_expansion(tension);
  }
  double stored_energy(StateView state) const override {
    return inner().stored_energy(inner_state(state));
  }
  double dissipation(double rate, StateView state) const override {
    const Own& s = state.as<Own>();
    return inner().dissipation(rate - s.moved / step_, inner_state(state)) + s.heat;
  }

 private:
  struct Own {
    double creep;   ///< so far [m]
    double growth;  ///< for the next step [m]
    double moved;   ///< of this step [m]
    double heat;    ///< [W]
  };

  double rate_, onset_, step_;
};

class TendonCreep final : public SpringEffect {
 public:
  TendonCreep() : SpringEffect(describe()) {}

 protected:
  std::shared_ptr<const SeriesElasticElement> wrap(const EffectSetting& setting,
                                                   const MuscleModel& muscle,
                                                   double step) const override {
    return std::make_shared<CreepingTendon>(muscle.spring,
                                            setting["rate"] * rest_tendon_length(*muscle.actuator),
                                            setting["onset"], step);
  }
};

const EffectRegistration kRegistration(std::make_unique<TendonCreep>());

}  // namespace
}  // namespace anthrob
