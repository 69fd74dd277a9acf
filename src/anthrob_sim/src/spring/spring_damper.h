#pragma once

#include "anthrob_sim/spring/series_elastic_element.h"

namespace anthrob {

/// Linear spring and damper in parallel (4.46):  f = max(0, k l_S + c dl_S/dt), no force when
/// slack.
class SpringDamper final : public SeriesElasticElement {
 public:
  /// @param rest_length l_0 [m], >= 0
  /// @param stiffness k [N/m], > 0      @param damping c [Ns/m], >= 0
  SpringDamper(double rest_length, double stiffness, double damping, double step)
      : rest_length_(rest_length), stiffness_(stiffness), damping_(damping), step_(step) {}

  std::size_t state_size() const override { return 1; }
  double rest_length() const override { return rest_length_; }
  void relax(double expansion, StateView state) const override { state[0] = expansion; }
  double advance(double expansion, StateView state) const override;
  double relaxed_tension(double expansion) const override;
  double relaxed_expansion(double tension) const override { return tension / stiffness_; }
  double stored_energy(StateView state) const override;
  double dissipation(double rate, StateView state) const override;

  static std::shared_ptr<const SeriesElasticElement> load(const ConfigNode& node, int quantity,
                                                          double step);

 private:
  double rest_length_, stiffness_, damping_, step_;
};

}  // namespace anthrob
