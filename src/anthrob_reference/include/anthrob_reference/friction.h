#pragma once

#include "anthrob_reference/parameters.h"

namespace anthrob::reference {

/// Smooth Stribeck curve, odd in v (4.75):
///   value(v) = (2 / (1 + exp(-kappa v / v_s)) - 1) (kinetic + (static - kinetic) exp(-|v| / v_s)).
/// Tendon at an eyelet, or dry friction of a joint.
class SmoothStribeck final {
 public:
  explicit SmoothStribeck(const StribeckParameters& parameters);

  double value(double velocity) const;
  /// d value / d velocity; the same on both sides of zero.
  double slope(double velocity) const;
  bool vanishes() const { return static_level_ == 0.0 && kinetic_level_ == 0.0; }
  /// Multiplies both levels by a factor >= 0.
  void scale(double factor);

 private:
  struct Terms {
    double sign;    // smooth sign of |v|, in [0, 1)
    double excess;  // over the kinetic level
  };
  Terms terms(double velocity) const;

  double static_level_;
  double kinetic_level_;
  double velocity_;
  double steepness_;
};

}  // namespace anthrob::reference
