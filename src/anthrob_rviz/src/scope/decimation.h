#pragma once

#include <vector>

#include "scope/samples.h"

namespace anthrob {

/// What to draw of samples between two instants on so many columns of pixels: of each column the
/// least and the greatest value, in their order, so that no peak is lost; beyond the ends one
/// sample each, so that the line reaches the edges. NaN stays where a column has nothing else.
/// Samples that are no more than two a column are returned as they are.
std::vector<Sample> decimated(SampleSpan samples, Nanoseconds begin, Nanoseconds end, int columns);

}  // namespace anthrob
