#pragma once

#include "anthrob_sim/spring/series_elastic_element.h"
#include "spring/maxwell_arm.h"
#include "spring/ring.h"

namespace anthrob {

/// Standard linear solid (4.47)-(4.56): a spring E_0 beside one Maxwell arm (E_1, tau_1). The
/// thesis integrates y = E_1 e - q instead of the arm's stress q; the arm is advanced exactly here.
class Zener final : public SeriesElasticElement {
 public:
  /// @param modulus E_0 [Pa], > 0
  Zener(const Ring& ring, double modulus, const MaxwellArm& arm)
      : ring_(ring), modulus_(modulus), arm_(arm) {}

  std::size_t state_size() const override { return state_size_of<State>(); }
  double rest_length() const override { return ring_.rest_length; }
  void relax(double expansion, StateView state) const override;
  double advance(double expansion, StateView state) const override;
  double relaxed_tension(double expansion) const override;
  double relaxed_expansion(double tension) const override;
  double stored_energy(StateView state) const override;
  double dissipation(double rate, StateView state) const override;

  static std::shared_ptr<const SeriesElasticElement> load(const ConfigNode& node, int quantity,
                                                          double step);

 private:
  struct State {
    double strain;      ///< [1]
    double arm_stress;  ///< [Pa]
  };

  Ring ring_;
  double modulus_;
  MaxwellArm arm_;
};

}  // namespace anthrob
