#pragma once

#include <cstddef>

#include "anthrob_reference/parameters.h"

namespace anthrob::reference {

struct MuscleState;
struct MuscleSolution;

/// A law added to the equations of one muscle. It has a hook at each stage of the force chain; the
/// hooks of this base class have no effect. Within an integration step a law is a pure function of
/// the state and of its own memory. Only settle() changes the memory, between two steps, so that a
/// step may be shortened and repeated. The memory lags by less than one step.
class MuscleLaw {
 public:
  virtual ~MuscleLaw() = default;

  /// Tendon on the spindle beyond r_S position, and its derivative, the radius beyond r_S [m].
  virtual double wound(double /*position*/) const { return 0.0; }
  virtual double leverage(double /*position*/) const { return 0.0; }
  /// Length of the tendon beyond l_T [m].
  virtual double elongation() const { return 0.0; }
  /// Additional force at this stretch of the ring [N]; a slack ring has none.
  virtual double spring_force(double /*stretch*/) const { return 0.0; }
  /// Coefficient of friction of an eyelet, and its slope [s/m]; `before` is the value without this
  /// law.
  virtual double friction(std::size_t /*eyelet*/, double /*sliding*/, double before) const {
    return before;
  }
  virtual double friction_slope(std::size_t /*eyelet*/, double /*sliding*/, double before) const {
    return before;
  }
  /// Additional torque on the gear's output [Nm].
  virtual double output_torque(double /*position*/, double /*speed*/) const { return 0.0; }

  /// An integration step of h [s] has led to this state.
  virtual void settle(double /*h*/, const MuscleState& /*state*/,
                      const MuscleSolution& /*solution*/) {}
  /// Changes the motor for the following steps; returns whether anything changed.
  virtual bool retune(MotorParameters* /*motor*/) { return false; }
};

}  // namespace anthrob::reference
