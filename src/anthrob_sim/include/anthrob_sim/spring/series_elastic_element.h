#pragma once

#include <memory>
#include <string>

#include "anthrob_core/config_node.h"
#include "anthrob_sim/core/state.h"

namespace anthrob {

/// The spring between actuator and tendon. Pulls only.
///
/// Built for one length of step. `expansion` is l_M - l_T - rest_length [m]; a slack element
/// (expansion < 0) has strain 0 and relaxes.
class SeriesElasticElement {
 public:
  virtual ~SeriesElasticElement() = default;

  virtual std::size_t state_size() const = 0;

  /// l_0: length of the unstretched element [m]
  virtual double rest_length() const = 0;

  /// Puts the element into the fully relaxed state at `expansion`.
  virtual void relax(double expansion, StateView state) const = 0;

  /// Stretches it from the last expansion to this one at constant speed within one step.
  /// @return tension at the end of the step [N], >= 0
  virtual double advance(double expansion, StateView state) const = 0;

  /// Fully relaxed tension [N], >= 0.
  virtual double relaxed_tension(double expansion) const = 0;
  /// The expansion whose fully relaxed tension is `tension` [m]: the inverse of relaxed_tension for
  /// tension > 0.
  virtual double relaxed_expansion(double tension) const = 0;

  /// Elastic energy [J].
  virtual double stored_energy(StateView state) const = 0;
  /// Power turned into heat, for the expansion speed `rate` [m/s] of the last step [W].
  virtual double dissipation(double rate, StateView state) const = 0;
};

/// A kind of element, as the model file lists it: `{type: zener, ...}`.
/// @param quantity equal elements in parallel, >= 1   @param step [s]
std::shared_ptr<const SeriesElasticElement> make_series_elastic_element(const ConfigNode& node,
                                                                        int quantity, double step);

}  // namespace anthrob
