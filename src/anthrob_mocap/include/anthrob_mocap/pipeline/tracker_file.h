#pragma once

#include <string>

#include "anthrob_mocap/pipeline/tracker.h"

namespace anthrob {
namespace mocap {

/// Options from a YAML file whose sections and keys are those of the structs; what is not named
/// keeps its default.
/// @throws BadInput with file, line, key and reason
TrackerOptions load_tracker_options(const std::string& file);

}  // namespace mocap
}  // namespace anthrob
