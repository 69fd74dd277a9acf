#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "scope/samples.h"

namespace anthrob {

/// How far two series are apart.
struct SeriesDifference {
  std::vector<Sample> difference;  ///< second - first, at the times of the first
  double rms = 0.0;                ///< root of the mean of its squares, one weight a sample
  double largest = 0.0;            ///< absolute value
};

/// The value between two samples, linearly interpolated; none beyond the ends or beside NaN.
std::optional<double> value_at(SampleSpan samples, Nanoseconds t);

/// The difference at all times of the first series that lie within the second one, which is
/// interpolated linearly there. NaN of either is left out.
/// @param later is added to the times of the second one
/// @return none if no time is left
std::optional<SeriesDifference> difference_between(SampleSpan first, SampleSpan second,
                                                   Nanoseconds later);

}  // namespace anthrob
