#pragma once

#include <string>

#include "anthrob_calib/discovery/discovery.h"

namespace anthrob {
namespace discovery {

/// report.json, for scripts (docs/files.md).
std::string report_json(const Answer& answer, const Question& question, double runtime);

/// report.html: one self-contained page, the answer first.
std::string report_html(const Answer& answer, const Question& question, double runtime);

/// model.yaml: extends the examined model by what was found; its comment names verdict and
/// recordings.
/// @param folder the folder in which it will be saved
std::string model_text(const Answer& answer, const Evaluator& evaluator, const Question& question,
                       const std::string& folder);

/// Protocols and postures for the recorder that tell effects from their first rivals. @return texts
/// by file name
std::map<std::string, std::string> separating_files(const Answer& answer, const RobotModel& model);
/// Removes protocols of an earlier answer from the folder.
/// @param files files of this answer by name, which stay
void remove_other_protocols(const std::string& folder,
                            const std::map<std::string, std::string>& files);
/// "separating_1.yaml", of the first effect.
std::string separating_file(std::size_t number);

/// A few lines for the terminal.
std::string summary(const Answer& answer);

/// Says that `max_effects` ended the search; empty if it did not.
std::string cap_remark(const Answer& answer, const Question& question);

/// "payload @ hand instead of both ... and ..., probability 0.5".
std::string alternative_text(const Alternative& alternative, const Answer& answer);

/// "0.0421 [0.038, 0.047] Nm"; without unit where there is none.
std::string interval_text(const FoundParameter& parameter);

/// "0.0421", three significant digits, or all before the point if there are more: "26123".
std::string short_number(double value);

/// "probability 0.93", or that it is above 0.999 or below 0.001: none is certain.
std::string probability_text(double probability);

}  // namespace discovery
}  // namespace anthrob
