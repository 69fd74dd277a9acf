#include "friction/smooth_stribeck.h"

#include <cmath>

namespace anthrob {

namespace {
/// Beyond it exp(-x) is lost beside 1.
constexpr double kSettled = 40.0;
}  // namespace

/// Asked several times for each contact in a step, at rest every other time: exponentials that
/// change no bit of the coefficient are left out.
FrictionLaw::Value SmoothStribeck::evaluate(double v, StateView) const {
  if (v == 0.0) return {0.0, 0.5 * kappa_ * static_ / velocity_};
  const double x = std::abs(v) / velocity_;
  const double decay = std::exp(-x);
  const double level = kinetic_ + (static_ - kinetic_) * decay;
  const double e = kappa_ * x < kSettled ? std::exp(-kappa_ * x) : 0.0;
  const double sign = (1.0 - e) / (1.0 + e);  // = 2 / (1 + e) - 1, without cancellation at rest
  const double sign_slope = 2.0 * kappa_ * e / ((1.0 + e) * (1.0 + e));
  const double slope = (sign_slope * level - sign * (static_ - kinetic_) * decay) / velocity_;
  return {std::copysign(sign * level, v), slope};
}

/// Not inherited: where the compiler sees evaluate(), it leaves out the slope with its divisions.
double SmoothStribeck::coefficient(double v, StateView state) const {
  return evaluate(v, state).mu;
}

std::shared_ptr<const FrictionLaw> SmoothStribeck::load(const ConfigNode& node, double) {
  return std::make_shared<SmoothStribeck>(
      node.number("static", Bounds::nonnegative(), "1"),
      node.number("kinetic", Bounds::nonnegative(), "1"),
      node.number("stribeck_velocity", Bounds::positive(), "m/s"),
      node.number("steepness", Bounds::positive(), "1"));
}

}  // namespace anthrob
