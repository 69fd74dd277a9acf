#pragma once

#include "experiment/evaluator.h"
#include "experiment/noise_floor.h"
#include "options/hypotheses.h"
#include "options/judgement.h"

namespace anthrob {
namespace discovery {

/// @return the longer step [s]; 0 if its error is larger, or if it cannot simulate the model
double coarse_step(const Evaluator& evaluator, const Experiments& train, const Scales& scales,
                   const LongerStepOptions& longer, const JudgementOptions& judgement);

}  // namespace discovery
}  // namespace anthrob
