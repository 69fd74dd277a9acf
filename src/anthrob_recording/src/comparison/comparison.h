#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"

namespace anthrob {

/// How far a channel of two recordings lies apart where both have it.
struct ChannelDifference {
  std::string channel;  ///< "biceps_brachii/force"; of a ball joint "shoulder", the angle between
  std::string unit;
  int samples = 0;  ///< of A, within the time of both; 0: there are none
  double rms = 0.0;
  double largest = 0.0;  ///< its absolute value
  double at = 0.0;       ///< time of the largest [s]
};

struct Comparison {
  std::vector<ChannelDifference> channels;  ///< in the order of A
  std::vector<std::string> only_a, only_b;
};

/// B minus A at the times of A, counted from the beginning of each recording. B is interpolated
/// between its samples; what one of them holds until the next (commands, references) is held.
/// Samples without a number do not count.
/// @throws BadInput if an orientation is no unit quaternion
Comparison compare(const Dataset& a, const Dataset& b);

}  // namespace anthrob
