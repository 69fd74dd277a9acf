#pragma once

#include <set>
#include <string>

#include "anthrob_core/files.h"
#include "calibration/calibration_outcome.h"

namespace anthrob {
namespace calibration {

// Figures of a calibration's report, as SVG text.

/// figures/fitness.svg: over evaluations, logarithmic.
/// figures/held_out_errors.svg, fitted_errors.svg: joint and force errors of every run, before and
/// after (Figures 8.2-8.13); of several runs only.
/// figures/held_out_trajectory.svg, fitted_trajectory.svg: the longest trajectory over time, joint
/// positions measured and simulated, errors before and after (Figures 8.5, 8.15, 8.16).
/// figures/profiles.svg: fitness along the least identifiable parameters.
OutputFiles calibration_figures(const CalibrationOutcome& outcome);

/// Names of those figures: "fitness".
const std::set<std::string>& kinds_of_figures();

}  // namespace calibration
}  // namespace anthrob
