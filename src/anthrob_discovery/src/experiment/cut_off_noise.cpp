#include "experiment/cut_off_noise.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <vector>

namespace anthrob {
namespace discovery {

namespace {

/// Mean above zero of a value with noise 1.
double mean_of(double value) {
  if (value > 6.0) return value;  // nothing is cut off
  return 0.5 * value * std::erfc(-value * M_SQRT1_2) +
         std::exp(-0.5 * value * value) / std::sqrt(2.0 * M_PI);
}

/// Noise that makes this share of the readings zero, and this mean of all.
double noise_of(double mean, double share, double step, int iterations) {
  const double quantile = boost::math::quantile(boost::math::normal(), share);
  double noise = mean / mean_of(-quantile);
  // Up to half a step is zero, too.
  for (int i = 0; i < iterations; ++i) noise = mean / mean_of(0.5 * step / noise - quantile);
  return noise;
}

}  // namespace

double mean_above_zero(double value, double noise) {
  return noise > 0.0 ? noise * mean_of(value / noise) : std::max(value, 0.0);
}

double cut_off_noise(const Series& readings, double step, const CutOffOptions& options) {
  std::vector<double> estimates;
  for (std::size_t i = 0; i < readings.t.size();) {
    double sum = 0.0;
    std::size_t zeros = 0, count = 0;
    int changes = 0;
    for (const double end = readings.t[i] + options.window;
         i < readings.t.size() && readings.t[i] < end; ++i, ++count) {
      const double value = readings.values[i];
      if (value < 0.0) return 0.0;
      sum += value;
      zeros += value == 0.0;
      changes += count > 0 && (value == 0.0) != (readings.values[i - 1] == 0.0);
    }
    const double share = static_cast<double>(zeros) / static_cast<double>(count);
    if (count < options.samples || share < options.least_zeros || share > options.most_zeros ||
        changes < options.changes)
      continue;
    estimates.push_back(
        noise_of(sum / static_cast<double>(count), share, step, options.iterations));
  }
  if (estimates.size() < options.windows) return 0.0;
  const auto middle = estimates.begin() + static_cast<std::ptrdiff_t>(estimates.size() / 2);
  std::nth_element(estimates.begin(), middle, estimates.end());
  return *middle;
}

}  // namespace discovery
}  // namespace anthrob
