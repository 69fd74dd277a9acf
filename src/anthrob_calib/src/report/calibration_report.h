#pragma once

#include <string>

#include "calibration/calibration_outcome.h"

namespace anthrob {
namespace calibration {

/// result.json. Without run times, so that equal calibrations give equal files.
std::string result_json(const CalibrationOutcome& outcome);
/// report.html: one self-contained page.
std::string report_html(const CalibrationOutcome& outcome);
/// A few lines for the terminal.
std::string summary(const CalibrationOutcome& outcome);

}  // namespace calibration
}  // namespace anthrob
