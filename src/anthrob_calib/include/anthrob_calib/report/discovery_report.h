#pragma once

#include <string>

#include "anthrob_calib/discovery/discovery.h"

namespace anthrob {
namespace discovery {

/// report.json, as scripts read it.
std::string report_json(const Answer& answer, const Question& question, double runtime);

/// report.html: one self-contained page, the answer first.
std::string report_html(const Answer& answer, const Question& question, double runtime);

/// model.yaml: extends the examined model by what was found, and says where that came from.
/// @param folder where it will be put
std::string model_text(const Answer& answer, const Evaluator& evaluator, const Question& question,
                       const std::string& folder);

/// For the recorder: protocols and postures that tell effects from their first rivals, by name.
std::map<std::string, std::string> separating_files(const Answer& answer, const RobotModel& model);
/// Of an earlier answer in the folder, which it does not explain any more.
/// @param files what belongs there, by name
void remove_other_protocols(const std::string& folder,
                            const std::map<std::string, std::string>& files);
/// "separating_1.yaml", of the first effect.
std::string separating_file(std::size_t number);

/// A few lines for the terminal.
std::string summary(const Answer& answer);

/// Whether `max_effects` ended the search, and that in words; empty if it did not.
std::string cap_remark(const Answer& answer, const Question& question);

/// "payload @ hand instead of both ... and ..., probability 0.5".
std::string alternative_text(const Alternative& alternative, const Answer& answer);

/// "0.0421 [0.038, 0.047] Nm"; without unit where there is none.
std::string interval_text(const FoundParameter& parameter);

/// "0.0421", three significant digits.
std::string short_number(double value);

/// "probability 0.93", or that it is above 0.999 or below 0.001: none is certain.
std::string probability_text(double probability);

}  // namespace discovery
}  // namespace anthrob
