#pragma once

#include <memory>
#include <string>

#include "scope/recording_source.h"

namespace anthrob {

/// Any topic of any bag, or a data set folder of ours, whose columns have the names that they would
/// have in a bag.
/// @throws BadInput with one line: file, and why it cannot be read
std::unique_ptr<RecordingSource> open_recording(const std::string& path);

}  // namespace anthrob
