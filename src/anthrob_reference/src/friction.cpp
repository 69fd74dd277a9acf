#include "anthrob_reference/friction.h"

#include <cmath>

#include "check.h"

namespace anthrob::reference {

SmoothStribeck::SmoothStribeck(const StribeckParameters& parameters)
    : static_level_(parameters.static_level),
      kinetic_level_(parameters.kinetic_level),
      velocity_(parameters.velocity),
      steepness_(parameters.steepness) {
  require_not_negative("static friction", static_level_);
  require_not_negative("kinetic friction", kinetic_level_);
  require_positive("Stribeck velocity", velocity_);
  require_positive("friction steepness", steepness_);
}

double SmoothStribeck::value(double velocity) const {
  const Terms t = terms(velocity);
  return std::copysign(t.sign * (kinetic_level_ + t.excess), velocity);
}

double SmoothStribeck::slope(double velocity) const {
  const Terms t = terms(velocity);
  const double rise = 0.5 * steepness_ * (1.0 - t.sign * t.sign) * (kinetic_level_ + t.excess);
  return (rise - t.sign * t.excess) / velocity_;
}

SmoothStribeck::Terms SmoothStribeck::terms(double velocity) const {
  const double v = std::abs(velocity) / velocity_;
  // Beyond this the exponential is below the rounding of 1: nothing is lost, only time is saved.
  constexpr double kSaturated = 40.0;
  const double z = steepness_ * v;
  const double sign = z > kSaturated ? 1.0 : 2.0 / (1.0 + std::exp(-z)) - 1.0;
  return {sign, (static_level_ - kinetic_level_) * std::exp(-v)};
}

void SmoothStribeck::scale(double factor) {
  require_not_negative("friction factor", factor);
  static_level_ *= factor;
  kinetic_level_ *= factor;
}

}  // namespace anthrob::reference
