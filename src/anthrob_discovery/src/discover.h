#pragma once

#include "conclusion/answer.h"
#include "experiment/evaluator.h"
#include "question/observer.h"
#include "question/question.h"

namespace anthrob {
namespace discovery {

/// Where model and recordings disagree, and which physical effect is missing
/// (docs/discovery_method.md).
/// @throws BadInput for recordings that cannot answer; Interrupted
Answer discover(const Evaluator& evaluator, const Question& question,
                const Observer& observer = {});

}  // namespace discovery
}  // namespace anthrob
