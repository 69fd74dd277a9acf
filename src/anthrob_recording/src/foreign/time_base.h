#pragma once

#include <vector>

#include "anthrob_recording/table.h"

namespace anthrob {

/// Puts tables of several clocks on rows of one rate, from the first sample of all to the last.
/// - What sensors measure has a cell in a row only if a sample lies within half a row of it:
/// between
///   two rows with cells nothing was measured. The value is that on the straight line between the
///   samples before and after the row, which has no delay; of three samples or more in a row, that
///   of the line fitted to them. Orientations turn along the shortest rotation.
/// - Voltages, efforts and loads hold until their next row, so each row has their mean until
///   then: the same impulse.
/// - References, modes and states have a cell in the first row that is not before them.
/// @param tables without pushes   @param rate [Hz]
/// @throws BadInput for more than 1e8 rows
std::vector<Table> on_time_base(const std::vector<Table>& tables, double rate);

}  // namespace anthrob
