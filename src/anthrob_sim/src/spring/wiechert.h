#pragma once

#include <vector>

#include "anthrob_sim/spring/series_elastic_element.h"
#include "spring/maxwell_arm.h"
#include "spring/ring.h"

namespace anthrob {

/// Generalised Maxwell model (4.57)-(4.59): a spring E_0 beside n Maxwell arms.
class Wiechert final : public SeriesElasticElement {
 public:
  /// @param modulus E_0 [Pa], > 0
  /// @param arms at least one
  Wiechert(const Ring& ring, double modulus, std::vector<MaxwellArm> arms)
      : ring_(ring), modulus_(modulus), arms_(std::move(arms)) {}

  std::size_t state_size() const override { return 1 + arms_.size(); }
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
  // State: strain, then the stress of each arm [Pa].
  Ring ring_;
  double modulus_;
  std::vector<MaxwellArm> arms_;
};

}  // namespace anthrob
