#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anthrob_recording/table.h"
#include "measurement/retimed.h"
#include "options/measurement.h"

namespace anthrob {
namespace discovery {

/// Values of a slower sensor in the rows of a faster table.
struct HeldSamples {
  double period = 0.0;       ///< of the fresh values [s]
  double uncertainty = 0.0;  ///< of the period [s]: beyond it, fresh rows would come at other times
  double row_period = 0.0;   ///< [s]
  TimesTaken taken;          ///< fresh rows, by the clock of the sensor
};

/// Looks for a clock of fresh values in columns that were sampled together, such as the four
/// numbers of an orientation. A row is fresh where one of them differs from the row before bit for
/// bit.
///
/// Frame i, taken at t0 + i T, appears in the first row at or after it. So all fresh rows lie
/// within one row's period behind their frames, which bounds T and t0. Of the t0 that are possible,
/// the latest is taken: it is the true one where both clocks are one, and elsewhere the beat of the
/// two leaves no other.
/// @return nothing if rows are fresh, or repeat without a clock, as those of coarse counters do
std::optional<HeldSamples> find_held(const Table& table, const std::vector<std::string>& columns,
                                     const HeldSampleOptions& options);

}  // namespace discovery
}  // namespace anthrob
