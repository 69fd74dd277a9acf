#pragma once

#include <optional>
#include <string>

#include "anthrob_recording/dataset.h"
#include "options/measurement.h"

namespace anthrob {
namespace discovery {

/// How a table's stamps run beside the clock of a simulation: t' = t + late + drift (t - middle).
struct ClockFit {
  double late = 0.0, late_sigma = 0.0;    ///< [s] in the middle of the table
  double drift = 0.0, drift_sigma = 0.0;  ///< [1]
};

/// Least squares of measured less simulated values of one table, to which a shift of the stamps
/// adds the rate of each quantity, and a drift its product with time. Errors are those of the
/// jackknife over blocks of time.
/// @return nothing where too little moves or too few rows are common
std::optional<ClockFit> fit_clock(const Table& measured, const Table& simulated,
                                  const ClockFitOptions& options);

}  // namespace discovery
}  // namespace anthrob
