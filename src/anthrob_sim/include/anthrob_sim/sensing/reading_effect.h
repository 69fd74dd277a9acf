#pragma once

#include <vector>

#include "anthrob_ecu/control_law.h"
#include "anthrob_sim/core/state.h"

namespace anthrob {

/// The values that sensors measure: the true values, as changed by the effects so far.
struct Readings {
  ecu::Measurement* muscles;  ///< one per muscle
  /// Joints as in Simulation::configuration, and their velocities, ball joints in the child's axes.
  double* positions;
  double* velocities;
};

/// A systematic error of sensors, applied before their delay, noise and rounding to counts.
/// Recordings of the simulator contain it, and controllers see it.
class ReadingEffect {
 public:
  virtual ~ReadingEffect() = default;
  virtual std::size_t state_size() const { return 0; }
  /// The robot was placed. Resets the state as if the readings so far had always been the given
  /// ones.
  virtual void reset(const Readings&, StateView) const {}
  /// Once a step.
  virtual void apply(Readings& readings, StateView state) const = 0;

  // Recordings contain readings. To impose recorded positions, the true ones must be known. So an
  // effect that changes how positions of muscles or joints are read also gives delay and inverse.
  /// Delay of a muscle's position reading [s].
  virtual double position_delay(std::size_t /*muscle*/) const { return 0.0; }
  /// Inverse: the true position of a muscle [rad] that the next apply() turns into `position`, not
  /// counting the delay.
  virtual double true_position(std::size_t /*muscle*/, double position, StateView) const {
    return position;
  }
  /// Delay of the readings of joint positions [s].
  virtual double joint_delay() const { return 0.0; }
  /// Inverse: replaces joint positions (as in Simulation::configuration) by the true ones that the
  /// next apply() turns into them, not counting the delay.
  virtual void true_joint_positions(double* /*positions*/) const {}
};

}  // namespace anthrob
