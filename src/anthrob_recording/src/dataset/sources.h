#pragma once

#include "anthrob_recording/dataset.h"

namespace anthrob {

/// Measurements that two nodes publish: two rows of one time with different values of one quantity,
/// or a joint that jumps to and fro between two positions. Commands may have several senders.
/// @throws BadInput that names table, column, time and values
void check_sources(const Dataset& dataset);

}  // namespace anthrob
