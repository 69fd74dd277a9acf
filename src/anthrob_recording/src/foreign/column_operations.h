#pragma once

#include <cstddef>
#include <vector>

namespace anthrob {

// What can be made of a column of samples. NaN is a sample that was not measured: it stays NaN, and
// the others do as if its row was not there.

/// Slope at each sample: of the parabola through it and its two neighbours (at the ends, through
/// the three last ones). Exact for parabolas, whatever the spacing.
/// @param t [s] increasing
std::vector<double> derivative_of(const std::vector<double>& t, const std::vector<double>& v);

/// Integral by trapezoids, `start` at the first sample.
std::vector<double> integral_of(const std::vector<double>& t, const std::vector<double>& v,
                                double start);

/// Values and slopes of parabolas fitted to the samples around each (Savitzky and Golay 1964, with
/// their times as they are). Exact for parabolas, without delay, also at the ends.
struct LocalFit {
  std::vector<double> value, slope;
  std::size_t most = 0;  ///< samples in the fullest window
};
/// @param over [s] length of the window. Where it holds fewer than three samples, the value is the
/// sample's own and the slope is derivative_of()'s.
LocalFit fit_locally(const std::vector<double>& t, const std::vector<double>& v, double over);

/// A quantity that wraps, such as an angle or a counter of so many counts, made continuous: steps
/// of more than half a period become shorter by whole periods.
std::vector<double> unwrapped(const std::vector<double>& v, double period);

/// Leaves samples only where `mark` differs from its value at the sample before; the first one
/// stays.
std::vector<double> fresh_of(const std::vector<double>& v, const std::vector<double>& mark);

}  // namespace anthrob
