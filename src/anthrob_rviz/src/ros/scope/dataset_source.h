#pragma once

#include <memory>
#include <string>

#include "scope/recording_source.h"

namespace anthrob {

/// A data set folder: <muscle>/force of muscles.csv is /ROBOT/muscle_states/force/<muscle>.
/// @throws BadInput with one line
std::unique_ptr<RecordingSource> open_dataset(const std::string& folder);

}  // namespace anthrob
