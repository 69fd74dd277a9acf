#pragma once

#include <string>

#include "conclusion/answer.h"
#include "question/question.h"

namespace anthrob {
namespace discovery {

/// The verdict in one line, with the effects that were found and where.
std::string headline(const Answer& answer);

/// A few lines for the terminal.
std::string summary(const Answer& answer);

/// Says that `max_effects`, or the number of rounds that it allows, ended the search; empty if it
/// did not.
std::string cap_remark(const Answer& answer, const Question& question);

/// "payload @ hand instead of both ... and ..., probability 0.5".
std::string alternative_text(const Alternative& alternative, const Answer& answer);

}  // namespace discovery
}  // namespace anthrob
