#pragma once

#include <string>

#include "pipeline/tracker.h"

namespace anthrob {
namespace mocap {

/// Reads options from a YAML file whose sections and keys are those of the structs. A key that is
/// absent keeps its default.
/// @throws BadInput with file, line, key and reason
TrackerOptions load_tracker_options(const std::string& file);

}  // namespace mocap
}  // namespace anthrob
