#pragma once

#include <cstddef>

#include "anthrob_reference/parameters.h"

namespace anthrob::reference {

struct MuscleState;
struct MuscleSolution;

/// What one muscle does beside its equations: a hook at each seam of the force chain, and every
/// hook is neutral here. Within an integration step a law is a pure function of the state and of
/// its own memory; only settle() changes the memory, between two steps, so that a step which is cut
/// and repeated leaves no trace. What is remembered lags by less than one step.
class MuscleLaw {
 public:
  virtual ~MuscleLaw() = default;

  /// Tendon on the spindle beyond r_S position, and its derivative, the radius beyond r_S [m].
  virtual double wound(double /*position*/) const { return 0.0; }
  virtual double leverage(double /*position*/) const { return 0.0; }
  /// Length of the tendon beyond l_T [m].
  virtual double elongation() const { return 0.0; }
  /// Force beside the ring's at this stretch of the ring [N]; a slack ring has none.
  virtual double spring_force(double /*stretch*/) const { return 0.0; }
  /// Coefficient of friction of an eyelet whose law so far says `before`, and its slope [s/m].
  virtual double friction(std::size_t /*eyelet*/, double /*sliding*/, double before) const {
    return before;
  }
  virtual double friction_slope(std::size_t /*eyelet*/, double /*sliding*/, double before) const {
    return before;
  }
  /// Torque on the gear's output beside motor and tendon [Nm].
  virtual double output_torque(double /*position*/, double /*speed*/) const { return 0.0; }

  /// An integration step of h [s] has led to this state.
  virtual void settle(double /*h*/, const MuscleState& /*state*/,
                      const MuscleSolution& /*solution*/) {}
  /// Changes the motor of the steps to come; returns whether anything changed.
  virtual bool retune(MotorParameters* /*motor*/) { return false; }
};

}  // namespace anthrob::reference
