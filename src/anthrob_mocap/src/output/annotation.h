#pragma once

#include <cstdint>
#include <vector>

#include "labelling/targets.h"
#include "pipeline/stereo_frame.h"

namespace anthrob {
namespace mocap {

/// An image in colour, 8-bit BGR, rows without padding.
struct ColourImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;
};

/// Left and right image side by side: blobs circled in yellow, markers of targets in the target's
/// colour with their numbers, and crosses where the pose expects markers that are not seen.
ColourImage annotate(const StereoFrame& frame, const StereoRig& rig, const TargetSet& set);

}  // namespace mocap
}  // namespace anthrob
