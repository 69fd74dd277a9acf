#pragma once

#include "anthrob_ecu/control_law.h"
#include "anthrob_sim/replay/replay.h"

namespace anthrob {

inline bool imposes_positions(ReplayMode mode) {
  return mode == ReplayMode::kPosition || mode == ReplayMode::kPosture;
}

/// The mode that a cell of a `mode` column stands for.
inline ecu::Mode mode_of(double word) {
  return static_cast<ecu::Mode>(static_cast<int>(word));
}

}  // namespace anthrob
