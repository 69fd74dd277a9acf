#pragma once

namespace anthrob {
namespace discovery {

/// Root mean squares in standard deviations of the floor.
struct Gap {
  double before = 0.0, recalibrated = 0.0, after = 0.0, floor = 0.0;
};

}  // namespace discovery
}  // namespace anthrob
