#pragma once

#include <Eigen/Core>
#include <vector>

namespace anthrob {

/// Size of one sensor count, in the unit of the values: the step of the grid on which all values
/// lie; 0 if no grid is found. Values that are not finite are ignored.
double resolution_of(std::vector<double> values);

/// Standard deviation of white noise on a smooth series, from the median of its third differences.
double white_noise(const Eigen::VectorXf& series);

}  // namespace anthrob
