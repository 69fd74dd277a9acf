#pragma once

#include "pipeline/stereo_frame.h"
#include "segmentation/segmenter.h"

namespace anthrob {
namespace mocap {

struct TrackerOptions {
  SegmentationOptions segmentation;
  MatchingOptions matching;
  LabellingOptions labelling;
  MotionOptions motion;
  PoseOptions pose;
  int most_points = 400;  ///< points in space; of more, the lowest in the picture are ignored
};

/// Options of the matcher, with the marker diameter of the targets.
MatchingOptions matching_of(const TargetSet& targets, const TrackerOptions& options);

/// The stages between a pair of images and the joints, in the order of Figure A.2. They keep
/// state between frames: use them for one stream of frames, in the order of time.
/// @throws std::invalid_argument if an option is out of range
std::vector<Stage> tracking_stages(const StereoRig& rig, const TargetSet& targets,
                                   const TrackerOptions& options);

}  // namespace mocap
}  // namespace anthrob
