#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiment/evaluator.h"

namespace anthrob {
namespace discovery {

/// The floor of one channel, for averages over a bin.
struct ChannelScale {
  std::string unit;
  /// Scatter between repeats or, without repeats, between neighbouring bins; at least the rounding
  /// error of the sensor, count / sqrt(12), which repeats share and therefore do not show, and that
  /// of a file that has few digits.
  double floor = 0.0;
  double numerics = 0.0;  ///< rms difference from a simulation with half the step
  double counts = 0.0;  ///< rms difference from one whose controllers see the counts of the sensors
  double inflation = 1.0;  ///< bins that count as one because noise is correlated; >= 1
  double rows = 1.0;       ///< measurements in a bin where the floor was measured
  double fewer_rows = ExperimentOptions{}.fewer_rows;

  double sigma() const { return sigma(rows); }
  /// Of a recording with fewer measurements in a bin, which averages less of the noise. One with
  /// more gets the floor as it is: noise that lasts is not averaged.
  double sigma(double rows_of_recording) const;
};

/// By Channel::name().
using Scales = std::map<std::string, ChannelScale>;

/// Floors of all channels. With repeats: rms difference between repeats / sqrt(2). Without: a
/// robust estimate from the third differences of neighbouring bins, which sees white noise only.
/// @param repeats further runs of the commands of train.front(), may be empty
/// @param lags by how many bins each repeat is behind it; empty: they start together
/// @throws BadInput if a repeat has other columns than the first recording
Scales measure_scales(const Evaluator& evaluator, const Experiments& train,
                      const Experiments& repeats, const std::vector<long>& lags,
                      const ExperimentOptions& options);

/// Factors that turn differences into numbers of standard deviations; 0 where nothing was measured.
/// @param independent divides by the square root of ChannelScale::inflation too, so that squares
/// can be summed as if all bins were independent
Eigen::VectorXf whitener(const Experiments& experiments, const Scales& scales, bool independent);

/// 1 + twice the sum of the autocorrelations of a series, up to where they vanish.
double correlation_length(const Eigen::VectorXf& series);

}  // namespace discovery
}  // namespace anthrob
