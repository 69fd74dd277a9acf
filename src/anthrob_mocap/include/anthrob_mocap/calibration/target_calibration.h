#pragma once

#include <vector>

#include "anthrob_mocap/labelling/targets.h"
#include "anthrob_mocap/triangulation/triangulator.h"

namespace anthrob {
namespace mocap {

struct TargetCalibration {
  MarkerTarget target;
  int frames = 0;           ///< used
  std::vector<double> rms;  ///< by marker, about its place in the target, over all frames [m]
  std::vector<int> seen;    ///< by marker: in how many frames
};

/// Where the markers of a target are, from frames in which it moves (section A.2): every frame is
/// labelled with what is known so far, brought onto the others, and the mean is what is known next
/// [generalised Procrustes]. The result stays where the first guess was, so it keeps its axes.
/// @param guess measured by hand, to a centimetre
/// @param frames points in space of every frame
/// @throws BadInput if markers are never seen or do not stay in place
TargetCalibration calibrate_target(const MarkerTarget& guess,
                                   const std::vector<std::vector<MarkerPoint>>& frames);

}  // namespace mocap
}  // namespace anthrob
