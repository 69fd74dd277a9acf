#pragma once

#include <optional>

#include "scope/samples.h"

namespace anthrob {

/// When an oscilloscope takes its picture.
struct Trigger {
  enum class Edge { kRising, kFalling, kEither };

  double level = 0.0;  ///< in the unit of the quantity
  Edge edge = Edge::kRising;
  Nanoseconds width = 1000000000;  ///< of the picture, > 0
  double pre = 0.2;                ///< share of it that lies before the crossing, 0 to 1
};

/// A picture: from begin to end around the crossing.
struct Sweep {
  Nanoseconds begin = 0, crossing = 0, end = 0;
};

/// The last crossing of the level whose picture is complete, interpolated between two samples. A
/// rising one goes from below the level to the level or above, a falling one the other way round.
/// None if there is none; beside NaN there is none.
std::optional<Sweep> last_sweep(SampleSpan samples, const Trigger& trigger);

}  // namespace anthrob
