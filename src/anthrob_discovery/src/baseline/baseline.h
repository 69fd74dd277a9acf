#pragma once

#include <Eigen/Core>

#include "hypotheses/hypotheses.h"
#include "question/observer.h"

namespace anthrob {
namespace discovery {

/// The model before any effect is added to it.
struct Baseline {
  Variant given;                            ///< as it was given
  Eigen::VectorXf given_train, given_test;  ///< its whitened residuals
  Tested recalibrated;                      ///< its ordinary parameters fitted
};

/// Fits the ordinary parameters of the given model: with the result all effects are compared.
/// @throws std::runtime_error if the model cannot be simulated; Interrupted
Baseline recalibrate(const Hypotheses& hypotheses, const Observer& observer);

}  // namespace discovery
}  // namespace anthrob
