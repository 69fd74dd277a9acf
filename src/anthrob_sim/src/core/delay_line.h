#pragma once

#include <cmath>

#include "anthrob_sim/core/state.h"

namespace anthrob {

/// Delays a group of signals by any time, not only by whole steps. Past values are kept in the
/// state.
class DelayLine {
 public:
  /// @param delay [s], >= 0   @param width signals in the group   @param step [s], > 0
  DelayLine(double delay, std::size_t width, double step)
      : width_(width),
        whole_(static_cast<std::size_t>(delay / step)),
        part_(delay / step - static_cast<double>(whole_)) {}

  std::size_t state_size() const { return 1 + slots() * width_; }

  /// Fills the past with these signals.
  void fill(const double* now, StateView state) const {
    state[0] = 0.0;
    for (std::size_t i = 0; i < slots() * width_; ++i) state[1 + i] = now[i % width_];
  }
  /// Takes the signals of this step.
  void push(const double* now, StateView state) const {
    const std::size_t newest = (static_cast<std::size_t>(state[0]) + 1) % slots();
    state[0] = static_cast<double>(newest);
    for (std::size_t i = 0; i < width_; ++i) state[1 + newest * width_ + i] = now[i];
  }
  /// Value of a signal `delay` ago, interpolated linearly between samples.
  double blended(std::size_t i, StateView state) const {
    return (1.0 - part_) * past(whole_, i, state) + part_ * past(whole_ + 1, i, state);
  }
  /// Whether a signal is the same in the samples on both sides of `delay` ago.
  bool between_equals(std::size_t i, StateView state) const {
    return past(whole_, i, state) == past(whole_ + 1, i, state);
  }
  /// The nearest sample, for signals that cannot be interpolated, such as modes.
  double nearest(std::size_t i, StateView state) const {
    return past(part_ < 0.5 ? whole_ : whole_ + 1, i, state);
  }

 private:
  std::size_t slots() const { return whole_ + 2; }
  double past(std::size_t ago, std::size_t i, StateView state) const {
    const std::size_t slot = (static_cast<std::size_t>(state[0]) + slots() - ago) % slots();
    return state[1 + slot * width_ + i];
  }

  std::size_t width_, whole_;
  double part_;
};

}  // namespace anthrob
