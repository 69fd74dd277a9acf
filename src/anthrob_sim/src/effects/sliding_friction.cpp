#include "anthrob_sim/effects/friction_effect.h"
#include "anthrob_sim/friction/smooth_stribeck.h"

namespace anthrob {

namespace {

/// A speed at which friction is kinetic [m/s].
constexpr double kFast = 1.0;
/// Of the thesis's law, section 7.2.4.
constexpr double kStaticOverKinetic = 1.25, kStribeckVelocity = 0.001, kSteepness = 10.0;

class Raised final : public FrictionLaw {
 public:
  Raised(std::shared_ptr<const FrictionLaw> law, double factor)
      : law_(std::move(law)), factor_(factor) {}
  std::size_t state_size() const override { return law_->state_size(); }
  Value evaluate(double v, StateView state) const override {
    const Value value = law_->evaluate(v, state);
    return {factor_ * value.mu, factor_ * value.slope};
  }
  double level(double speed) const override { return factor_ * law_->level(speed); }
  void commit(double v, StateView state) const override { law_->commit(v, state); }

 private:
  std::shared_ptr<const FrictionLaw> law_;
  double factor_;
};

}  // namespace

std::shared_ptr<const FrictionLaw> raise_friction(const std::shared_ptr<const FrictionLaw>& law,
                                                  double mu) {
  const double kinetic = law ? law->level(kFast) : 0.0;
  if (kinetic > 0.0) return std::make_shared<Raised>(law, 1.0 + mu / kinetic);
  return std::make_shared<SmoothStribeck>(kStaticOverKinetic * mu, mu, kStribeckVelocity,
                                          kSteepness);
}

}  // namespace anthrob
