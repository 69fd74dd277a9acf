#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace anthrob {
namespace identification {

/// Half of a normal 95 % interval, in standard deviations.
constexpr double kNormal95 = 1.959963984540054;

/// A number with its standard error and confidence interval.
struct Estimate {
  double value = 0.0;
  double sigma = 0.0;         ///< standard error
  double lo = 0.0, hi = 0.0;  ///< 95 % confidence interval
};

/// Of list[begin] to list[end - 1].
double mean(const std::vector<double>& list, std::size_t begin, std::size_t end);

/// @param freedom degrees of freedom of `sigma`, >= 1; the interval is by Student's distribution
Estimate make_estimate(double value, double sigma, double freedom);

/// Adds an independent error of known size [unit of the value]: that of a scale, a gauge, a radius.
Estimate widened(const Estimate& estimate, double sigma);

/// Mean and standard deviation of a list.
struct Spread {
  double mean = 0.0, deviation = 0.0;
};
Spread spread(const std::vector<double>& values);

/// Mean of a correlated series. Its error is computed from the means of blocks; blocks must be
/// longer than the correlation.
/// @param block samples in a block, >= 1; @throws std::invalid_argument for less than two blocks
Estimate mean_of_series(const std::vector<double>& series, std::size_t block);

}  // namespace identification
}  // namespace anthrob
