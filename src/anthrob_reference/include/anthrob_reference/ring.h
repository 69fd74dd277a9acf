#pragma once

#include "anthrob_reference/parameters.h"

namespace anthrob::reference {

/// O-ring as a Zener solid with the strain rate eliminated (4.53)-(4.56). State y [Pa]:
///   stress = (E_0 + E_1) strain - y,   dy/dt = (E_1 strain - y) / tau_1,
///   strain = max(0, l_M - l_T - l_0) / l_0,   force = quantity strands (pi d^2 / 4) max(0,
///   stress).
/// A slack ring has strain 0 and goes on relaxing.
class Ring final {
 public:
  explicit Ring(const RingParameters& parameters);

  /// @param gap l_M - l_T, the room that path and tendon leave for the ring [m].
  double strain(double gap) const;
  /// [N], >= 0
  double force(double strain, double y) const;
  /// dy/dt [Pa/s]
  double rate(double strain, double y) const;
  /// y of a ring that has rested at this strain for ever [Pa].
  double relaxed(double strain) const { return arm_modulus_ * strain; }

 private:
  double rest_length_;
  double modulus_;
  double arm_modulus_;
  double relaxation_time_;
  double area_;  // of all strands of all rings [m^2]
};

}  // namespace anthrob::reference
