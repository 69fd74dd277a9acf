#pragma once

#include <ostream>
#include <string>

#include "pipeline/stereo_frame.h"

namespace anthrob {
namespace mocap {

/// poses.csv: per target valid, position, quaternion and rms in the rectified left frame; per joint
/// valid and quaternion. What is not seen is `valid = 0` with empty cells.
class PoseTable {
 public:
  /// Writes the header.
  PoseTable(std::ostream& out, const TargetSet& targets);
  void add(const StereoFrame& frame);

 private:
  std::ostream& out_;
};

}  // namespace mocap
}  // namespace anthrob
