#pragma once

#include "optimiser/evaluator.h"

namespace anthrob {
namespace calibration {

/// Result of one local minimisation.
struct Descent {
  enum End {
    kMoreToGain,  ///< no Jacobian was left
    kConverged,
    kStuck,  ///< the solver failed
    kInvalidStart,
  };
  Point point;
  double fitness = 0.0;  ///< infinite if the start is invalid
  End end = kMoreToGain;
  /// For each variable the norm of the derivative of all residuals, per step, at the point where it
  /// was largest; empty if no Jacobian was computed.
  std::vector<double> sensitivity = {};
};

/// Levenberg-Marquardt within bounds (Ceres). A Jacobian by finite differences costs one evaluation
/// per variable. After each step it is updated by Broyden's secant (rank one), as long as steps
/// with it still improve the fitness; then it is computed again.
/// @param difference of the finite differences [steps]
/// @param jacobians number of finite-difference Jacobians that are still allowed; counted down
Descent descend(const std::vector<SearchVariable>& variables, double difference, const Point& from,
                Evaluator& evaluator, int& jacobians);

}  // namespace calibration
}  // namespace anthrob
