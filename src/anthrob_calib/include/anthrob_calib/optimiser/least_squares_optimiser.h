#pragma once

#include <Eigen/Core>

#include "anthrob_calib/optimiser/optimiser.h"

namespace anthrob {
namespace calibration {

/// Ways down by descend(); `generations` is the largest number of their Jacobians by differences.
/// Tendons that go slack make kinks and several valleys: where it has converged it descends once
/// more by derivatives that reach across kinks, and from the best of the points far along each
/// variable (five evaluations a variable find them); what is better is gone on from.
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

/// How the variables do best, to first order, when one of them changes by a step.
/// @param information normal equations by steps, positive definite
Eigen::VectorXd following(const Eigen::MatrixXd& information, std::size_t variable);

/// @param direction by steps   @return within bounds
Point moved(const std::vector<SearchVariable>& variables, const Point& from,
            const Eigen::VectorXd& direction, double steps);

}  // namespace calibration
}  // namespace anthrob
