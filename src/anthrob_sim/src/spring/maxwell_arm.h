#pragma once

#include <cmath>

#include "anthrob_core/config_node.h"

namespace anthrob {

/// Spring and dashpot in series (Appendix B.2):  dq/dt + q / tau = E de/dt, with q the stress and e
/// the strain. Exact for a strain that changes linearly within the step.
class MaxwellArm {
 public:
  /// @param modulus E [Pa], > 0    @param relaxation_time tau = mu / E [s], > 0    @param step [s],
  /// > 0
  MaxwellArm(double modulus, double relaxation_time, double step)
      : modulus_(modulus), relaxation_time_(relaxation_time) {
    const double x = step / relaxation_time;
    keep_ = std::exp(-x);
    gain_ = modulus * (-std::expm1(-x) / x);
  }

  /// @return stress after the step [Pa]
  double advance(double stress, double strain_change) const {
    return keep_ * stress + gain_ * strain_change;
  }
  /// Energy of the spring, and power of the dashpot, per volume [J/m^3, W/m^3].
  double energy_density(double stress) const { return 0.5 * stress * stress / modulus_; }
  double heat_density(double stress) const {
    return stress * stress / (modulus_ * relaxation_time_);
  }

  /// Reads `modulus` (under another name, where the element has its own) and `relaxation_time`.
  static MaxwellArm load(const ConfigNode& node, const std::string& modulus_key, double step) {
    return MaxwellArm(node.number(modulus_key, Bounds::positive(), "Pa"),
                      node.number("relaxation_time", Bounds::positive(), "s"), step);
  }

 private:
  double modulus_, relaxation_time_, keep_, gain_;
};

}  // namespace anthrob
