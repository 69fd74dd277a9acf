#pragma once

#include <string>

#include "calibration/calibration_outcome.h"

namespace anthrob {
namespace calibration {

/// Fitness over evaluations, with all individuals (Fig. 8.2).
std::string fitness_figure(const std::vector<Generation>& history);

/// What the recordings leave of each parameter's range.
std::string identifiability_figure(const Identifiability& identifiability,
                                   const std::vector<ModelParameter>& parameters);

/// Fitness along the least identifiable parameters.
std::string profile_figure(const Identifiability& identifiability,
                           const std::vector<ModelParameter>& parameters, double best_fitness);

}  // namespace calibration
}  // namespace anthrob
