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
/// The verdict in one line: whether the model is usable, or which parameters to look at first
/// because they ended at a bound or are not identifiable.
/// @param searched whether the search came to its end
std::string headline(const CalibrationOutcome& outcome, bool searched);
/// A few lines for the terminal.
std::string summary(const CalibrationOutcome& outcome);

}  // namespace calibration
}  // namespace anthrob
