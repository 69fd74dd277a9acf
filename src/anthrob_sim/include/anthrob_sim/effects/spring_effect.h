#pragma once

#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"
#include "anthrob_sim/spring/spring_wrapper.h"

namespace anthrob {

/// l_T at position 0 [m].
inline double rest_tendon_length(const Actuator& actuator) {
  std::vector<double> state(actuator.state_size() + 1);
  actuator.place(0.0, StateView(state.data()));
  return actuator.tendon_length(StateView(state.data()));
}

/// MUSCLE | all: a wrapper around the series elastic element, or an element in series with it.
class SpringEffect : public MuscleEffect {
 public:
  using MuscleEffect::MuscleEffect;

 protected:
  void change(const EffectSetting& setting, ModelDraft& draft, std::size_t muscle) const override {
    MuscleModel& model = draft.robot.muscles[muscle];
    model.spring = wrap(setting, model, draft.robot.step);
  }
  virtual std::shared_ptr<const SeriesElasticElement> wrap(const EffectSetting& setting,
                                                           const MuscleModel& muscle,
                                                           double step) const = 0;
};

}  // namespace anthrob
