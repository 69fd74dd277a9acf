#include "anthrob_sim/friction/smooth_stribeck.h"

#include <cmath>

namespace anthrob {

FrictionLaw::Value SmoothStribeck::evaluate(double v, StateView) const {
  const double x = std::abs(v) / velocity_;
  const double decay = std::exp(-x);
  const double level = kinetic_ + (static_ - kinetic_) * decay;
  const double e = std::exp(-kappa_ * x);
  const double sign = (1.0 - e) / (1.0 + e);  // = 2 / (1 + e) - 1, without cancellation at rest
  const double sign_slope = 2.0 * kappa_ * e / ((1.0 + e) * (1.0 + e));
  const double slope = (sign_slope * level - sign * (static_ - kinetic_) * decay) / velocity_;
  return {std::copysign(sign * level, v), slope};
}

std::shared_ptr<const FrictionLaw> SmoothStribeck::load(const ConfigNode& node, double) {
  return std::make_shared<SmoothStribeck>(
      node.number("static", Bounds::nonnegative(), "1"),
      node.number("kinetic", Bounds::nonnegative(), "1"),
      node.number("stribeck_velocity", Bounds::positive(), "m/s"),
      node.number("steepness", Bounds::positive(), "1"));
}

}  // namespace anthrob
