#pragma once

#include <vector>

#include "experiment/evaluator.h"
#include "experiment/measured_variable.h"
#include "options/options.h"

namespace anthrob {
namespace discovery {

/// The angle by which each tendon turns on its way over eyelets and surfaces [rad], computed by the
/// model in the measured postures, as variables "<muscle>/wrap_angle". Only of muscles where it
/// changes. Empty if a joint was not measured.
std::vector<MeasuredVariable> wrap_angles(const Evaluator& evaluator,
                                          const std::vector<Dataset>& recordings,
                                          const Experiments& experiments, const Variant& variant,
                                          const Options& options);

}  // namespace discovery
}  // namespace anthrob
