#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "joint/joint_estimator.h"
#include "labelling/labeller.h"
#include "matching/epipolar_matcher.h"
#include "pipeline/pipeline.h"
#include "pose/pose_estimator.h"
#include "segmentation/blob.h"

namespace anthrob {
namespace mocap {

/// A pair of images and all that the stages find in it, each member the output of one stage.
struct StereoFrame final : Packet {
  std::uint64_t index = 0;
  double t = 0.0;       ///< [s] exposure
  std::int64_t ns = 0;  ///< the same [ns], exactly as in the source; of the left image
  std::array<ImageView, 2> image;
  std::array<std::shared_ptr<const void>, 2> owner;  ///< keeps the pixels alive
  std::array<std::string, 2> file;                   ///< the file it was read from; empty if none
  std::optional<std::string> fault;  ///< why the pair cannot be used; its images are empty then

  std::array<std::vector<Blob>, 2> blobs;      ///< segmentation
  std::array<bool, 2> cluttered{};             ///< too many specks to be a scene of markers
  std::array<std::vector<Vec2>, 2> rectified;  ///< undistortion
  std::vector<Match> matches;                  ///< matching
  bool cut = false;                   ///< too many matches: the lowest in the picture were left out
  std::vector<MarkerPoint> points;    ///< triangulation
  std::vector<Edge> edges;            ///< points to edges
  std::vector<Labelling> labels;      ///< labelling, by target
  std::vector<TargetPose> targets;    ///< pose, by target
  std::vector<JointEstimate> joints;  ///< joint, by joint

  /// Empties the images, so that the stages see nothing.
  void leave_out(const std::string& why) {
    fault = why;
    image = {};
    owner = {};
  }
};

}  // namespace mocap
}  // namespace anthrob
