#pragma once

#include <cstddef>
#include <vector>

namespace anthrob {
namespace identification {

/// Rows in which a ring is held at one length.
struct RingHold {
  std::size_t begin = 0, end = 0;  ///< rows begin to end - 1
  double position = 0.0;           ///< mean [rad]
  bool released = false;           ///< at the lowest position of all
};

/// Finds them in what was measured, whatever was commanded: the position of the spindle stays
/// within a fiftieth of its whole travel for half a second.
/// @param t [s], growing   @param position [rad]
std::vector<RingHold> find_holds(const std::vector<double>& t, const std::vector<double>& position);

}  // namespace identification
}  // namespace anthrob
