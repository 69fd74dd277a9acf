#pragma once

#include "anthrob_calib/optimiser/optimiser.h"

namespace anthrob {
namespace calibration {

/// Levenberg-Marquardt within bounds from Ceres, derivatives by differences of kDifference steps.
/// `generations` is the largest number of iterations.
class LeastSquaresOptimiser final : public Optimiser {
 public:
  static constexpr double kDifference = 0.02;

  explicit LeastSquaresOptimiser(const OptimiserSettings& settings) : settings_(settings) {}
  SearchResult minimise(const std::vector<SearchVariable>& variables,
                        Evaluator& evaluator) const override;

 private:
  OptimiserSettings settings_;
};

/// Derivatives of residuals by steps of the variables, one row a residual, one column a variable;
/// differences go the way that stays within bounds. A column of an invalid neighbour is zero.
/// @param residuals at `point`
std::vector<std::vector<double>> derivatives(const std::vector<SearchVariable>& variables,
                                             const Point& point,
                                             const std::vector<double>& residuals,
                                             double difference, Evaluator& evaluator);

}  // namespace calibration
}  // namespace anthrob
