#include <cmath>

#include "anthrob_sim/effects/friction_effect.h"
#include "friction/smooth_stribeck.h"

namespace anthrob {

namespace {

/// A speed at which friction is kinetic [m/s].
constexpr double kFast = 1.0;
/// Below this share of the static level it is what the Stribeck curve leaves of that: none that
/// could be scaled.
constexpr double kNoLevel = 1e-6;
/// Of the thesis's law, section 7.2.4.
constexpr double kStaticOverKinetic = 1.25, kStribeckVelocity = 0.001, kSteepness = 10.0;

/// A law times 1 + factor, at rest 1 + factor rest_ratio.
class Raised final : public FrictionLaw {
 public:
  Raised(std::shared_ptr<const FrictionLaw> law, double factor, double rest_ratio)
      : law_(std::move(law)), factor_(factor), at_rest_(factor * (rest_ratio - 1.0)) {}
  std::size_t state_size() const override { return law_->state_size(); }
  Value evaluate(double v, StateView state) const override {
    const Value value = law_->evaluate(v, state);
    const double more = excess(std::abs(v)), raised = 1.0 + factor_ + more;
    // The excess falls with the speed; mu has the sign of v or, of bristles, that of their bend.
    const double falling = more * std::copysign(1.0, v) * value.mu / kStribeckVelocity;
    return {raised * value.mu, raised * value.slope - falling};
  }
  double sliding_coefficient(double speed) const override {
    return (1.0 + factor_ + excess(speed)) * law_->sliding_coefficient(speed);
  }
  void commit(double v, StateView state) const override { law_->commit(v, state); }

 private:
  double excess(double speed) const {
    return at_rest_ == 0.0 ? 0.0 : at_rest_ * std::exp(-speed / kStribeckVelocity);
  }

  std::shared_ptr<const FrictionLaw> law_;
  double factor_, at_rest_;
};

/// Two laws at one place: their coefficients add up. The second has no state.
class Sum final : public FrictionLaw {
 public:
  Sum(std::shared_ptr<const FrictionLaw> law, const SmoothStribeck& more)
      : law_(std::move(law)), more_(more) {}
  std::size_t state_size() const override { return law_->state_size(); }
  Value evaluate(double v, StateView state) const override {
    const Value a = law_->evaluate(v, state), b = more_.evaluate(v, state);
    return {a.mu + b.mu, a.slope + b.slope};
  }
  double sliding_coefficient(double speed) const override {
    return law_->sliding_coefficient(speed) + more_.sliding_coefficient(speed);
  }
  void commit(double v, StateView state) const override { law_->commit(v, state); }

 private:
  std::shared_ptr<const FrictionLaw> law_;
  SmoothStribeck more_;
};

}  // namespace

std::shared_ptr<const FrictionLaw> raise_friction(const std::shared_ptr<const FrictionLaw>& law,
                                                  double mu, double rest_ratio) {
  const double kinetic = law ? law->sliding_coefficient(kFast) : 0.0;
  if (law && kinetic > kNoLevel * law->sliding_coefficient(0.0)) {
    return std::make_shared<Raised>(law, mu / kinetic, rest_ratio);
  }
  const SmoothStribeck added(kStaticOverKinetic * rest_ratio * mu, mu, kStribeckVelocity,
                             kSteepness);
  if (law) return std::make_shared<Sum>(law, added);
  return std::make_shared<SmoothStribeck>(added);
}

std::vector<EffectParameter> friction_parameters(double typical) {
  return {{"mu", "1", "kinetic coefficient, added to the model's", 0.0, typical, {0.0, 1.0}},
          {"rest_ratio",
           "1",
           "static over kinetic of the added friction, relative to the law's",
           1.0,
           1.0,
           {0.5, 2.0},
           EffectParameter::kShape}};
}

}  // namespace anthrob
