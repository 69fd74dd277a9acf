#pragma once

#include <optional>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "experiment/evaluator.h"

namespace anthrob {
namespace discovery {

/// What the given model does under the inputs of each recording, in its rows; nothing of a robot
/// without muscles, and where the model cannot be simulated to the end.
std::vector<std::optional<Dataset>> replays(const Evaluator& evaluator,
                                            const std::vector<Dataset*>& recordings,
                                            std::optional<ReplayMode> feed);

}  // namespace discovery
}  // namespace anthrob
