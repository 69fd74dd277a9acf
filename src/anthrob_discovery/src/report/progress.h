#pragma once

#include <cstddef>
#include <string>

#include "experiment/evaluator.h"

namespace anthrob {
namespace discovery {

/// Progress of a stage in words. The remaining time of a stage is unknown, because what is done
/// next depends on what was found; that of a batch of simulations can be estimated.
/// @param elapsed since the beginning of the stage [s]   @param simulated in this stage
std::string progress_text(double elapsed, std::size_t simulated, const Batch& batch);

}  // namespace discovery
}  // namespace anthrob
