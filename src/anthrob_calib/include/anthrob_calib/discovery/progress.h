#pragma once

#include <cstddef>
#include <string>

#include "anthrob_calib/discovery/evaluator.h"

namespace anthrob {
namespace discovery {

/// Where a stage of discovery is. How much of it is left is known of no stage, for what is done
/// next depends on what was found; of a batch of simulations it is.
/// @param elapsed since the stage was begun [s]   @param simulated in this stage
std::string progress_text(double elapsed, std::size_t simulated, const Batch& batch);

}  // namespace discovery
}  // namespace anthrob
