#pragma once

#include <Eigen/Core>
#include <vector>

namespace anthrob {

/// One count of the sensor that these values come from, in their unit: they all lie on a grid of
/// that step. 0: none to be seen. Those that are not finite are left out.
double resolution_of(std::vector<double> values);

/// Standard deviation of white noise on a smooth series: by its third differences, of which the
/// median is taken.
double white_noise(const Eigen::VectorXf& series);

}  // namespace anthrob
