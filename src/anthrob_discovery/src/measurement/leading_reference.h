#pragma once

#include <string>

#include "anthrob_recording/dataset.h"

namespace anthrob {
namespace discovery {

/// Replaces the positions that a muscle should go to, r, by those that make a law with the
/// derivative of the measurement do what one with the derivative of the error does:
///   K_P (r' - position) - K_D velocity = K_P (r - position) + K_D (dr/dt - velocity)
///   r' = r + (K_D / K_P) dr/dt
/// dr/dt is a difference over one tick: where rows are rarer, another one follows a tick later.
/// @param lead K_D / K_P [s]   @param tick of the controllers [s]
void lead_reference(const std::string& muscle, double lead, double tick, Dataset& recording);

}  // namespace discovery
}  // namespace anthrob
