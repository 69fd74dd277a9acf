#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "anthrob_core/config_node.h"
#include "anthrob_core/random.h"
#include "anthrob_sim/core/state.h"
#include "anthrob_sim/skeleton/kinematic_tree.h"

namespace anthrob {

/// Errors of a sensor; the default is an ideal sensor.
struct SensorModel {
  double noise = 0.0;    ///< standard deviation of white noise [unit of the quantity]
  double quantum = 0.0;  ///< size of one count [unit of the quantity]
  double delay = 0.0;    ///< [s]
  int average = 1;       ///< ECU ticks in the moving average (its FIR filter); 1: none

  bool ideal() const { return noise == 0.0 && quantum == 0.0 && delay == 0.0 && average == 1; }

  /// `{noise:, quantum:, delay:, average:}`, all optional
  static SensorModel load(const ConfigNode& node, const std::string& unit);
};

/// Sensor of one quantity: delay, then noise, then rounding to counts, then a moving average over
/// the values at the ECU's ticks.
class Sensor {
 public:
  /// @param stream different for every sensor of a robot   @param step [s]
  /// @param steps_per_tick simulation steps from one sample of the average to the next, >= 1
  Sensor(const SensorModel& model, std::uint64_t seed, std::uint64_t stream, double step,
         int steps_per_tick);

  std::size_t state_size() const { return ideal_ ? 0 : 4 + delay_steps_ + model_.average; }
  /// Fills the sensor's past with this value.
  void reset(double value, StateView state) const;
  /// To be called once every step with the true value; `index` counts the steps. An average is
  /// updated when `index` is a multiple of `steps_per_tick`, and held in between.
  double measure(double value, std::uint64_t index, StateView state) const {
    return ideal_ ? value : distorted(value, index, state);
  }

 private:
  double distorted(double value, std::uint64_t index, StateView state) const;
  double averaged(double value, bool tick, StateView state) const;

  SensorModel model_;
  bool ideal_;
  CounterRandom random_;
  std::size_t delay_steps_;
  std::uint64_t steps_per_tick_;
};

/// A force-sensitive resistor on a hand that closes on itself: at the end of its travel, fingers
/// and palm press on each other, and each pad carries its share of that. It feels no other bodies.
struct TouchPadModel {
  std::string name;
  int joint = 0;       ///< hinge whose upper stop is the closed hand
  double lever = 0.0;  ///< from the hinge to the pad [m], > 0
  double share = 0.0;  ///< of the stop's torque that this pad carries [1], 0..1
};

/// Force normal to the pad [N], >= 0.
double pad_force(const TouchPadModel& pad, const KinematicTree& tree, const std::vector<double>& q);

}  // namespace anthrob
