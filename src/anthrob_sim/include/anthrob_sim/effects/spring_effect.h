#pragma once

#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"
#include "anthrob_sim/spring/series_elastic_element.h"

namespace anthrob {

/// Wraps an element: passes every call on to it, except for those that a subclass overrides. The
/// subclass's own state comes first.
class SpringWrapper : public SeriesElasticElement {
 public:
  SpringWrapper(std::shared_ptr<const SeriesElasticElement> inner, std::size_t own_size)
      : inner_(std::move(inner)), own_size_(own_size) {}

  std::size_t state_size() const override { return own_size_ + inner_->state_size(); }
  double rest_length() const override { return inner_->rest_length(); }

 protected:
  const SeriesElasticElement& inner() const { return *inner_; }
  StateView inner_state(StateView state) const { return state.from(own_size_); }

 private:
  std::shared_ptr<const SeriesElasticElement> inner_;
  std::size_t own_size_;
};

/// Adds a force in parallel to an element: f = max(0, f_inner + force), and 0 when slack. The force
/// may be negative, but the sum must not fall with increasing stretch.
class ParallelForce : public SpringWrapper {
 public:
  /// @param own_size state of the subclass   @param step [s]
  ParallelForce(std::shared_ptr<const SeriesElasticElement> inner, std::size_t own_size,
                double step);

  void relax(double expansion, StateView state) const final;
  double advance(double expansion, StateView state) const final;
  double relaxed_tension(double expansion) const final;
  double relaxed_expansion(double tension) const final;
  double stored_energy(StateView state) const final;
  double dissipation(double rate, StateView state) const final;

 protected:
  // Stretch is the expansion where it is positive, else 0 [m].
  /// Puts the force into its fully relaxed state at `stretch`.
  virtual void settle(double stretch, StateView own) const = 0;
  /// Force after a move from one stretch to the next within a step [N].
  virtual double force(double from, double to, StateView own) const = 0;
  /// Fully relaxed force [N].
  virtual double settled_force(double stretch) const = 0;
  virtual double energy(double stretch, StateView own) const = 0;
  /// Power that becomes heat, for a speed of stretch [m/s] in the last step [W].
  virtual double heat(double stretch, double rate, StateView own) const = 0;

  double step() const { return step_; }

 private:
  struct Own {
    double stretch;  ///< [m]
    double rate;     ///< of it, in the last step [m/s]
    double lifted;   ///< what taking the maximum with 0 adds [N]
  };
  static StateView subclass(StateView state) { return state.from(state_size_of<Own>()); }

  double step_;
};

/// Typical working stretch of an element [m]: a strain of 30 %, or 3 mm without rest length.
double working_stretch(const SeriesElasticElement& element);
/// Tension over stretch there [N/m]; exact where the element is linear.
double working_stiffness(const SeriesElasticElement& element);

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
