#pragma once

#include <array>
#include <string>
#include <vector>

#include "anthrob_calib/discovery/measured_variable.h"

namespace anthrob {
namespace discovery {

/// Of a measured quantity: about equally many bins are low, in the middle and high; a value that
/// most have is in the middle.
constexpr int kLevels = 3;

/// A quantity that says how a place is used, and its level at every bin.
struct Regime {
  std::string word;                      ///< "speed", "load", "posture", "wrap angle", "time"
  std::vector<std::vector<int>> levels;  ///< by experiment and bin, 0 ... kLevels - 1
};

Regime regime_of(const MeasuredVariable& variable);

/// A place's first speed, and its first load or else posture; what was not measured is left out.
std::vector<Regime> regimes_of(const std::string& place,
                               const std::vector<MeasuredVariable>& variables);

/// How a place's disagreement, all its channels together, depends on one of its regimes.
struct RegimeGap {
  std::string place, word;
  std::array<double, kLevels> gap;  ///< rms [standard deviations of the floor]; -1: no such bins
};

/// One row of a heat map, place x regime, for each place and for its regimes, the angle by which
/// its tendon wraps, and time.
/// @param residual, whitener independent, as of whitener(..., true)
std::vector<RegimeGap> regime_gaps(const Experiments& experiments,
                                   const std::vector<MeasuredVariable>& variables,
                                   const Eigen::VectorXf& residual, const Eigen::VectorXf& whitener,
                                   const Scales& scales);

}  // namespace discovery
}  // namespace anthrob
