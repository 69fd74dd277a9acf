#include "anthrob_sim/sensing/sensor.h"

#include <cmath>
#include <utility>

namespace anthrob {

namespace {
// State: next slot of the delay line, next slot of the average, samples in it, their sum; then both
// lines.
enum Slot : std::size_t { kDelayNext, kAverageNext, kAverageCount, kAverageSum, kLines };

double take_turn(double& next, std::size_t size) {
  const double slot = next;
  next = slot + 1.0 < static_cast<double>(size) ? slot + 1.0 : 0.0;
  return slot;
}
}  // namespace

SensorModel SensorModel::load(const ConfigNode& node, const std::string& unit) {
  SensorModel model;
  model.noise = node.number_or("noise", 0.0, Bounds::nonnegative(), unit);
  model.quantum = node.number_or("quantum", 0.0, Bounds::nonnegative(), unit);
  model.delay = node.number_or("delay", 0.0, Bounds::between(0.0, 1.0), "s");
  if (node.has("average")) model.average = node.at("average").as_integer(1, 1000);
  return model;
}

Sensor::Sensor(const SensorModel& model, std::uint64_t seed, std::uint64_t stream, double step,
               int steps_per_tick)
    : model_(model),
      ideal_(model.ideal()),
      random_(seed, stream),
      delay_steps_(static_cast<std::size_t>(std::lround(model.delay / step))),
      steps_per_tick_(static_cast<std::uint64_t>(steps_per_tick)) {}

void Sensor::reset(double value, StateView state) const {
  if (ideal_) return;
  state[kDelayNext] = state[kAverageNext] = state[kAverageCount] = state[kAverageSum] = 0.0;
  for (std::size_t i = 0; i < delay_steps_; ++i) state[kLines + i] = value;
}

double Sensor::distorted(double value, std::uint64_t index, StateView state) const {
  if (delay_steps_ > 0) {
    double& slot =
        state[kLines + static_cast<std::size_t>(take_turn(state[kDelayNext], delay_steps_))];
    std::swap(slot, value);
  }
  if (model_.noise > 0.0) value += model_.noise * random_.normal(index);
  if (model_.quantum > 0.0) value = model_.quantum * std::round(value / model_.quantum);
  return model_.average > 1 ? averaged(value, index % steps_per_tick_ == 0, state) : value;
}

double Sensor::averaged(double value, bool tick, StateView state) const {
  // The first value after a reset counts whenever it comes: there is no other.
  if (tick || state[kAverageCount] == 0.0) {
    const std::size_t size = static_cast<std::size_t>(model_.average);
    double& slot = state[kLines + delay_steps_ +
                         static_cast<std::size_t>(take_turn(state[kAverageNext], size))];
    if (state[kAverageCount] < static_cast<double>(size)) {
      state[kAverageCount] += 1.0;
    } else {
      state[kAverageSum] -= slot;
    }
    slot = value;
    state[kAverageSum] += value;
  }
  return state[kAverageSum] / state[kAverageCount];
}

}  // namespace anthrob
