#pragma once

#include <memory>
#include <string>

#include "anthrob_core/config_node.h"
#include "anthrob_sim/core/state.h"

namespace anthrob {

/// A generalised force of which only the limits are known, as that of static friction [Nm, N].
struct ForceRange {
  double low = 0.0, high = 0.0;
};

/// Friction coefficient of a tendon that slides over an eyelet or a surface, for the capstan
/// equation
///   f_origin = f_insertion exp(mu alpha)
/// (4.69)-(4.76) with alpha the angle by which the tendon is deflected. v > 0: the tendon slides
/// towards its origin, which pulls harder then: mu has the sign of v. Built for one length of step.
class FrictionLaw {
 public:
  struct Value {
    double mu;     ///< [1]
    double slope;  ///< d mu / d v [s/m]; may be negative where friction falls with speed
  };

  virtual ~FrictionLaw() = default;

  virtual std::size_t state_size() const = 0;
  /// @param v sliding speed at the end of the step [m/s]
  virtual Value evaluate(double v, StateView state) const = 0;
  /// evaluate().mu, for callers that need no slope.
  virtual double coefficient(double v, StateView state) const { return evaluate(v, state).mu; }
  /// Coefficient while sliding at a speed >= 0, without its sign: the Stribeck curve [1].
  virtual double sliding_coefficient(double speed) const = 0;
  /// Updates the state for a step with sliding speed v [m/s].
  virtual void commit(double v, StateView state) const = 0;
};

/// `{law: none | smooth_stribeck | sticking, ...}`; null for none.  @param step [s]
std::shared_ptr<const FrictionLaw> make_friction_law(const ConfigNode& node, double step);

}  // namespace anthrob
