#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identification/estimate.h"

namespace anthrob {
namespace identification {

/// A least-squares problem of a few parameters.
struct LeastSquares {
  struct Parameter {
    double start;
    double scale;  ///< size of a typical change, > 0; the solver works with value / scale
    double lower, upper;
  };

  std::vector<Parameter> parameters;
  std::size_t residual_count = 0;
  /// Residuals, and their derivatives (row-major, one row a residual) unless that is null.
  std::function<void(const double* parameters, double* residuals, double* derivatives)> evaluate;
  /// Block of each residual, counted from 0, not decreasing. Residuals of one block may be
  /// correlated; those of different blocks are taken as independent. Empty: all residuals are
  /// independent and of equal size.
  std::vector<int> block;
};

/// The parameters that fit best, and their errors.
struct Fit {
  std::vector<double> values;
  /// Covariance of the parameters. With blocks it is computed from the scatter of their gradients
  /// (the sandwich estimator of robust statistics, jackknifed), so that it holds for correlated
  /// residuals of unequal size, too.
  Eigen::MatrixXd covariance;
  int freedom = 0;                      ///< blocks (or residuals, without) minus parameters
  double deviation = 0.0;               ///< root mean square of the residuals
  std::optional<std::size_t> at_bound;  ///< index of the first parameter that ends at a bound

  /// With its 95 % interval.
  Estimate estimate(std::size_t i) const;
};

/// Levenberg-Marquardt (Ceres).
/// @throws std::runtime_error with one line if it does not converge, if the parameters cannot be
/// distinguished, or if there are not more blocks than parameters
Fit solve(const LeastSquares& problem);

}  // namespace identification
}  // namespace anthrob
