#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "anthrob_ecu/protocol.h"

namespace anthrob {
namespace driver {

/// A sensor whose value is gain * (count - offset): potentiometers, strain gauges.
struct LinearSensor {
  double gain = 1.0;    ///< [unit/count], not 0
  double offset = 0.0;  ///< [counts] at value 0

  /// Counts outside are at a converter's end stops: they come from a broken cable, not from a
  /// value.
  static bool measures(int count) {
    return count >= ecu::kLowestCount && count <= ecu::kHighestCount;
  }
  double value(double count) const { return gain * (count - offset); }
  /// The 12-bit count a converter gives for a value.
  int count(double value) const {
    return static_cast<int>(std::lround(std::clamp(offset + value / gain, 0.0, 4095.0)));
  }
};

/// A force-sensitive resistor at the top of a voltage divider. Its conductance grows linearly with
/// the force, so force = gain * u / (1 - u) with u = count / 4096.
struct ForceSensitiveResistor {
  double gain = 1.0;        ///< [N] force at half the supply voltage, > 0
  double threshold = 20.0;  ///< [counts] below this the pad is not touched

  /// NaN at the converter's upper end stop, which means a short circuit. A cut cable cannot be
  /// distinguished from a pad that is not touched.
  double force(double count) const {
    if (count < threshold) return 0.0;
    if (count > ecu::kHighestCount) return std::numeric_limits<double>::quiet_NaN();
    const double u = count / 4096.0;
    return gain * u / (1.0 - u);
  }
  int count(double force) const {
    const double u = force / (gain + std::max(force, 0.0));
    return static_cast<int>(std::lround(std::min(4096.0 * u, 4095.0)));
  }
};

}  // namespace driver
}  // namespace anthrob
