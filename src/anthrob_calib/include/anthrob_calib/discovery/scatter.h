#pragma once

#include "anthrob_calib/discovery/naming.h"
#include "anthrob_calib/discovery/settling.h"

namespace anthrob {
namespace discovery {

/// Fits of one law to one recording end apart for no reason, and the true law may differ from what
/// is fitted by as much: evidence of that size decides nothing, however many blocks agree.
/// @param by_blocks how likely one law is right and not the other, by the blocks of recordings
/// @param base fitted without them
/// @param one, other fitted to the end
/// @return that, no surer than the scatter lets it be
double allowing_for_scatter(double by_blocks, const Settling& settling, const Tested& base,
                            const Tested& one, const Tested& other);

}  // namespace discovery
}  // namespace anthrob
