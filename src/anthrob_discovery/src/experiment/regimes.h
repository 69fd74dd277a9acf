#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiment/measured_variable.h"

namespace anthrob {
namespace discovery {

/// Levels of a measured quantity: low, middle and high, with about equally many bins each. A value
/// that most bins have is in the middle.
enum Level { kLow, kMiddle, kHigh, kLevels };

/// A quantity that says how a place is used, and its level at every bin.
struct Regime {
  std::string word;                      ///< "speed", "load", "posture", "wrap angle", "time"
  std::vector<std::vector<int>> levels;  ///< by experiment and bin, 0 ... kLevels - 1
};

Regime regime_of(const MeasuredVariable& variable);

/// The regimes of a place: its first speed, and its first load or else posture. What was not
/// measured is left out.
std::vector<Regime> regimes_of(const std::string& place,
                               const std::vector<MeasuredVariable>& variables);

/// The gap of a place, all its channels together, at the levels of one regime.
struct RegimeGap {
  std::string place, word;
  /// Root mean squares [standard deviations of the floor]; nothing where there are no such bins.
  std::array<std::optional<double>, kLevels> gap;
};

/// Rows of the heat map: for each place one row for each of its regimes, for the angle by which its
/// tendon wraps, and for time.
/// @param residual, whitener independent, as of whitener(..., true)
std::vector<RegimeGap> regime_gaps(const Experiments& experiments,
                                   const std::vector<MeasuredVariable>& variables,
                                   const Eigen::VectorXf& residual, const Eigen::VectorXf& whitener,
                                   const Scales& scales);

}  // namespace discovery
}  // namespace anthrob
