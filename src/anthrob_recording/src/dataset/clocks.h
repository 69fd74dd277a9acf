#pragma once

#include "anthrob_recording/dataset.h"

namespace anthrob {

/// One clock stamps a recording: simulated time beside the time of day, or a clock that is an hour
/// slow, would make a replay of years out of seconds.
/// @throws BadInput if a file lies more than a minute apart from all others; one that begins more
/// than a minute before them (a latched message) gets a remark
void check_clocks(Dataset& dataset);

}  // namespace anthrob
