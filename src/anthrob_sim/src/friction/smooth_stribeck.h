#pragma once

#include <cmath>

#include "anthrob_sim/friction/friction_law.h"

namespace anthrob {

/// The thesis's law (4.75): Stribeck curve times a logistic function for the sign. Continuous, so
/// it cannot hold at rest: a loaded tendon creeps.
///   mu(v) = [2 / (1 + exp(-kappa v / v_s)) - 1] [mu_k + (mu_s - mu_k) exp(-|v| / v_s)]
class SmoothStribeck final : public FrictionLaw {
 public:
  /// @param static_mu mu_s, @param kinetic_mu mu_k, both >= 0
  /// @param stribeck_velocity v_s [m/s], > 0   @param steepness kappa [1], > 0
  SmoothStribeck(double static_mu, double kinetic_mu, double stribeck_velocity, double steepness)
      : static_(static_mu), kinetic_(kinetic_mu), velocity_(stribeck_velocity), kappa_(steepness) {}

  std::size_t state_size() const override { return 0; }
  Value evaluate(double v, StateView state) const override;
  double coefficient(double v, StateView state) const override;
  double sliding_coefficient(double speed) const override {
    return kinetic_ + (static_ - kinetic_) * std::exp(-speed / velocity_);
  }
  void commit(double, StateView) const override {}

  static std::shared_ptr<const FrictionLaw> load(const ConfigNode& node, double step);

 private:
  double static_, kinetic_, velocity_, kappa_;
};

}  // namespace anthrob
