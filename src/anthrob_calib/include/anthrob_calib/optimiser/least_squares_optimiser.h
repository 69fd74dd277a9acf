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

/// Derivatives of (rough) residuals by steps of the variables, one list of them a variable;
/// differences go the way that stays within bounds. Those by an invalid neighbour are zero.
/// @param count of the residuals
std::vector<std::vector<double>> derivatives(const std::vector<SearchVariable>& variables,
                                             const Point& point, std::size_t count,
                                             double difference, Evaluator& evaluator);

}  // namespace calibration
}  // namespace anthrob
