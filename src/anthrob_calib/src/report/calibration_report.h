#pragma once

#include <string>

#include "anthrob_core/files.h"
#include "calibration/calibration_outcome.h"

namespace anthrob {
namespace calibration {

/// result.json. Without run times, so that equal calibrations give equal files.
/// @param figures of the report, which it names
std::string result_json(const CalibrationOutcome& outcome, const OutputFiles& figures = {});
/// result.json and figures/*.svg: what the page, templates/calibration.html.j2, is made from.
OutputFiles report_files(const CalibrationOutcome& outcome);
/// A few lines for the terminal.
std::string summary(const CalibrationOutcome& outcome);

}  // namespace calibration
}  // namespace anthrob
