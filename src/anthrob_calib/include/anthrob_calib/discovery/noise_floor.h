#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "anthrob_calib/discovery/evaluator.h"

namespace anthrob {
namespace discovery {

/// How exactly one quantity of one place can be known, averaged over a bin.
struct ChannelScale {
  std::string unit;
  /// Scatter of repeats, or of neighbouring bins where there are none; no less than what a count of
  /// the sensor errs by: repeats share that, so that their scatter does not show it.
  double floor = 0.0;
  double numerics = 0.0;   ///< difference to a simulation with half the step
  double counts = 0.0;     ///< difference to one whose controllers see the recorded sensors' counts
  double inflation = 1.0;  ///< bins that count as one, because their noise is correlated; >= 1

  double sigma() const;
};

/// By Channel::name().
using Scales = std::map<std::string, ChannelScale>;

/// Floors of all channels. With repeats: rms difference of repeats / sqrt 2. Without: a robust
/// estimate from the third differences of neighbouring bins, which sees white noise only.
/// @param repeats further runs of the commands of train.front(), may be empty
/// @param lags by how many bins each repeat is behind it; none: they start together
/// @throws BadInput if a repeat cannot be laid over the first recording
Scales measure_scales(const Evaluator& evaluator, const Experiments& train,
                      const Experiments& repeats, const std::vector<long>& lags = {});

/// Factors that turn differences into numbers of standard deviations; 0 where nothing was measured.
/// @param independent divides by the square root of ChannelScale::inflation too, so that squares
/// can be summed as if all bins were independent
Eigen::VectorXf whitener(const Experiments& experiments, const Scales& scales, bool independent);

/// 1 + twice the sum of the autocorrelations of a series, up to where they vanish.
double correlation_length(const Eigen::VectorXf& series);

}  // namespace discovery
}  // namespace anthrob
