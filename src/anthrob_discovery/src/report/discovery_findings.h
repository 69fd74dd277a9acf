#pragma once

#include <string>

#include "conclusion/answer.h"
#include "question/question.h"

namespace anthrob {
namespace discovery {

/// Gaps of all channels together, before and after, of training and held-out recordings.
std::string gap_table(const Answer& answer);

/// Each effect with its parameters, rivals and the experiment that tells them apart; then what was
/// not named.
std::string findings(const Answer& answer, const Question& question);

}  // namespace discovery
}  // namespace anthrob
