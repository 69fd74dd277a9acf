#pragma once

#include "anthrob_sim/recording/dataset.h"

namespace anthrob {

/// A recording from a dataset folder or from a bag (by its ending `.bag`).
/// @throws BadInput with one line
Dataset load_recording(const std::string& path);

}  // namespace anthrob
