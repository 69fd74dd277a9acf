#pragma once

#include "experiment/evaluator.h"
#include "experiment/noise_floor.h"

namespace anthrob {
namespace discovery {

/// A longer step for simulations of which only differences are used.
struct LongerStep {
  double times;       ///< the usual one
  double most_error;  ///< what it alone may change, rms of a channel [standard deviations]
};

/// @return the longer step [s]; 0 if its error is larger, or if it cannot simulate the model
double coarse_step(const Evaluator& evaluator, const Experiments& train, const Scales& scales,
                   const LongerStep& longer);

}  // namespace discovery
}  // namespace anthrob
