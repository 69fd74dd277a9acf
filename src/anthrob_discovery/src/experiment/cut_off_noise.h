#pragma once

#include "anthrob_recording/dataset.h"
#include "options/experiment.h"

namespace anthrob {
namespace discovery {

/// Mean of the readings of a sensor that never reports less than zero, for a true value with normal
/// noise. For a slack tendon (value 0) it is 0.4 standard deviations: no offset of the sensor is
/// needed to explain it.
/// @param value, noise standard deviation [N]
double mean_above_zero(double value, double noise);

/// Standard deviation of the noise of readings that were cut off at zero [N], from the windows of
/// time in which about half of them are zero; 0 if there are few of those, or readings below zero.
/// @param count step of the readings [N]; 0: none
double cut_off_noise(const Series& readings, double count, const CutOffOptions& options);

}  // namespace discovery
}  // namespace anthrob
