#pragma once

#include <cmath>

#include "anthrob_sim/friction/friction_law.h"

namespace anthrob {

/// Friction that truly sticks: an elastic bristle that breaks away. As long as the tendon has moved
/// less than the presliding distance z_s since it last turned back, mu = mu_s z / z_s; beyond, it
/// slides and mu follows the Stribeck curve mu_k + (mu_s - mu_k) exp(-|v| / v_s). Constant load
/// below mu_s: no creep at all, because mu depends on displacement and not on speed (Prandtl's
/// element; compare (4.70)-(4.74)).
class Sticking final : public FrictionLaw {
 public:
  /// @param presliding z_s [m], > 0
  Sticking(double static_mu, double kinetic_mu, double stribeck_velocity, double presliding,
           double step)
      : static_(static_mu),
        kinetic_(kinetic_mu),
        velocity_(stribeck_velocity),
        presliding_(presliding),
        step_(step) {}

  std::size_t state_size() const override { return 1; }
  Value evaluate(double v, StateView state) const override;
  double sliding_coefficient(double speed) const override {
    return kinetic_ + (static_ - kinetic_) * std::exp(-speed / velocity_);
  }
  void commit(double v, StateView state) const override;

  static std::shared_ptr<const FrictionLaw> load(const ConfigNode& node, double step);

 private:
  double static_, kinetic_, velocity_, presliding_, step_;
};

}  // namespace anthrob
