#pragma once

#include "anthrob_calib/optimiser/evaluator.h"

namespace anthrob {
namespace calibration {

/// Where a way down ended.
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
  /// By how much all residuals together change with a step of each variable, where its derivative
  /// was largest; empty if none was taken.
  std::vector<double> sensitivity = {};
};

/// Levenberg-Marquardt within bounds (Ceres). A Jacobian by differences costs an
/// evaluation a variable; after a step it is brought up to date by Broyden's secant, of rank one,
/// as long as steps by it help, and only then taken anew.
/// @param difference of derivatives [steps]
/// @param jacobians by differences that may be taken; counted down
Descent descend(const std::vector<SearchVariable>& variables, double difference, const Point& from,
                Evaluator& evaluator, int& jacobians);

}  // namespace calibration
}  // namespace anthrob
