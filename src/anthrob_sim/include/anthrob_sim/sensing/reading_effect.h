#pragma once

#include <vector>

#include "anthrob_ecu/control_law.h"
#include "anthrob_sim/core/state.h"

namespace anthrob {

/// What the sensors are given to measure. It begins as the truth.
struct Readings {
  ecu::Measurement* muscles;  ///< one a muscle
  /// Joints as in Simulation::configuration, and their velocities, ball joints in the child's axes.
  double* positions;
  double* velocities;
};

/// A systematic error of sensors, before their delay, noise and counts. Recordings of the simulator
/// show it, and controllers see it.
class ReadingEffect {
 public:
  virtual ~ReadingEffect() = default;
  virtual std::size_t state_size() const { return 0; }
  /// The robot is put somewhere: as if it had always been there, and the effects before this one
  /// had always read what they read now.
  virtual void reset(const Readings&, StateView) const {}
  /// Once a step.
  virtual void apply(Readings& readings, StateView state) const = 0;

  // What is recorded is what was read. To impose recorded positions, it must be known what was
  // there; an effect that changes how positions of muscles, or of joints, are read says both.
  /// By how much a muscle's position is read late [s].
  virtual double lateness(std::size_t /*muscle*/) const { return 0.0; }
  /// The position of a muscle [rad] that the next apply() turns into this one, lateness apart.
  virtual double undone(std::size_t /*muscle*/, double position, StateView) const {
    return position;
  }
  /// By how much positions of joints are read late [s].
  virtual double joint_lateness() const { return 0.0; }
  /// Turns positions of joints, as in Simulation::configuration, into those that the next apply()
  /// turns into these, lateness apart.
  virtual void undo_joints(double* /*positions*/) const {}
};

}  // namespace anthrob
