#pragma once

#include <vector>

#include "labelling/targets.h"
#include "triangulation/triangulator.h"

namespace anthrob {
namespace mocap {

struct TargetCalibration {
  MarkerTarget target;
  int frames = 0;           ///< used
  std::vector<double> rms;  ///< by marker: deviation from its place, over all frames [m]
  std::vector<int> seen;    ///< by marker: in how many frames
};

/// Measures where the markers of a target are (section A.2) [generalised Procrustes]. Each round
/// labels all frames with the markers as known so far, aligns the frames, and takes the mean as the
/// next estimate. The result is aligned with the guess, so it keeps its axes. The target may move
/// or stand still. A frame counts if at least four markers (or all three of three) are seen.
/// @param guess measured by hand, to a centimetre
/// @param frames points in space of every frame
/// @throws BadInput if a marker is seen in fewer than 20 frames, scatters by more than 1.5 mm or
///   comes out more than 20 mm from the guess, or if the target comes out mirrored
TargetCalibration calibrate_target(const MarkerTarget& guess,
                                   const std::vector<std::vector<MarkerPoint>>& frames);

}  // namespace mocap
}  // namespace anthrob
