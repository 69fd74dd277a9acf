#pragma once

#include <string>

#include "conclusion/answer.h"
#include "experiment/evaluator.h"
#include "question/question.h"

namespace anthrob {
namespace discovery {

/// model.yaml: extends the examined model by what was found; its comment names the verdict
/// and what was asked.
/// @param folder the folder in which it will be saved
std::string model_text(const Answer& answer, const Evaluator& evaluator, const Question& question,
                       const std::string& folder);

}  // namespace discovery
}  // namespace anthrob
