#pragma once

#include <Eigen/Core>

#include "optimiser/optimiser.h"

namespace anthrob {
namespace calibration {

/// Local minimisations by descend(). `generations` is the largest number of finite-difference
/// Jacobians in all of them.
/// Tendons that go slack make kinks and several minima. So where it has converged, it starts again
/// with derivatives over larger differences, which reach across kinks, and then from the best of
/// the points far along each variable (finding them takes five evaluations per variable, which do
/// not count as `generations`). If one of them ends clearly lower, the search continues there.
class LeastSquaresOptimiser final : public Optimiser {
 public:
  static constexpr double kDifference = 0.02;

  explicit LeastSquaresOptimiser(const OptimiserSettings& settings) : settings_(settings) {}
  SearchResult minimise(const std::vector<SearchVariable>& variables,
                        Evaluator& evaluator) const override;

 private:
  OptimiserSettings settings_;
};

/// Derivatives of the residuals with respect to each variable, in steps, by one-sided differences:
/// one list per variable, one entry per residual. Differences are taken to the side that stays
/// within bounds, or to the other one if that point is invalid. If both are, the list is zero.
/// @param residuals at `point`
std::vector<std::vector<double>> derivatives(const std::vector<SearchVariable>& variables,
                                             const Point& point,
                                             const std::vector<double>& residuals,
                                             double difference, Evaluator& evaluator);

/// How all variables change, in steps, if one of them changes by one step and the others compensate
/// for it as well as they can to first order.
/// @param information matrix of the normal equations in steps, positive definite
Eigen::VectorXd following(const Eigen::MatrixXd& information, std::size_t variable);

/// The point moved by a number of steps along a direction, clipped to the bounds.
/// @param direction in steps
Point moved(const std::vector<SearchVariable>& variables, const Point& from,
            const Eigen::VectorXd& direction, double steps);

}  // namespace calibration
}  // namespace anthrob
