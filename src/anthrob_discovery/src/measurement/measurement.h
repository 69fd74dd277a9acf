#pragma once

#include "experiment/evaluator.h"
#include "measurement/description.h"

namespace anthrob {
namespace discovery {

/// Finds out how the recordings were taken, and undoes what is not as the model's `sensors:` say.
/// @param question that was admitted
Description describe(const Evaluator& evaluator, const Question& question);

}  // namespace discovery
}  // namespace anthrob
