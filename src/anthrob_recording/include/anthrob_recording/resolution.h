#pragma once

#include <Eigen/Core>
#include <vector>

namespace anthrob {

/// Size of one sensor count, in the unit of the values: the step of the grid on which all values
/// lie; 0 if no grid is found. Values that are not finite are ignored.
double resolution_of(std::vector<double> values);

/// Step between numbers that were printed with so many significant digits as these, as a root mean
/// square over them; 0 for more than seven digits, or for numbers too few to tell. Zeros and values
/// that are not finite are ignored.
double step_of_digits(const std::vector<double>& values);

/// Standard deviation of white noise on a smooth series, from the median of its third differences.
double white_noise(const Eigen::VectorXf& series);

}  // namespace anthrob
