#pragma once

#include <string>

#include "calibration/calibration_outcome.h"

namespace anthrob {
namespace calibration {

// Figures of a calibration's report, as SVG text.

/// Fitness over evaluations, logarithmic.
std::string fitness_figure(const std::vector<Generation>& history);
/// Joint and force errors of every run, before and after (Figures 8.2-8.13).
std::string run_error_figure(const BeforeAfter& both, const RobotModel& model,
                             const std::string& title);
/// One trajectory over time: joint positions measured and simulated, errors before and after
/// (Figures 8.5, 8.15, 8.16). Needs `after`.
std::string trajectory_figure(const BeforeAfter& both, std::size_t run, const RobotModel& model);
/// Fitness along the least identifiable parameters.
std::string profile_figure(const Identifiability& identifiability,
                           const std::vector<ModelParameter>& parameters, double best_fitness);

}  // namespace calibration
}  // namespace anthrob
