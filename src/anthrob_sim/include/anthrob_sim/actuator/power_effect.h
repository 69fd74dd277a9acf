#pragma once

#include <vector>

#include "anthrob_sim/core/state.h"

namespace anthrob {

/// One muscle between its controller and its motor's terminals.
struct PowerLine {
  double voltage;  ///< of the controller; effects change it into that of the terminals [V]
  double current;  ///< of the motor [A]
};

/// Changes voltages on their way from the controllers to the motors.
class PowerEffect {
 public:
  virtual ~PowerEffect() = default;
  virtual std::size_t state_size() const { return 0; }
  /// The robot was placed, at rest.
  virtual void reset(StateView) const {}
  /// Once a step.  @param lines one a muscle
  virtual void apply(std::vector<PowerLine>& lines, StateView state) const = 0;
};

}  // namespace anthrob
