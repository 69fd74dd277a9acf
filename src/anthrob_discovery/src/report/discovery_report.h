#pragma once

#include <string>

#include "conclusion/answer.h"
#include "question/question.h"

namespace anthrob {
namespace discovery {

/// report.json, for scripts (docs/files.md).
/// @param runtime of the search [s]
std::string report_json(const Answer& answer, const Question& question, double runtime);

/// report.html: one self-contained page, the answer first.
/// @param runtime of the search [s]
std::string report_html(const Answer& answer, const Question& question, double runtime);

}  // namespace discovery
}  // namespace anthrob
