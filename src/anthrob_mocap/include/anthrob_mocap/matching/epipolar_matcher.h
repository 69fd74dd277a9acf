#pragma once

#include <array>
#include <vector>

#include "anthrob_mocap/camera/stereo_rig.h"
#include "anthrob_mocap/segmentation/blob.h"

namespace anthrob {
namespace mocap {

struct MatchingOptions {
  double epipolar_tolerance = 1.0;  ///< delta of (A.2) [pixel]
  double min_depth = 0.15;          ///< [m]
  double max_depth = 6.0;           ///< [m]
  double marker_diameter = 0.0;     ///< [m]; 0: sizes say nothing
  double size_factor = 2.0;  ///< how far a blob's radius may be off the marker's at its depth
};

/// A blob of each image that could show the same marker.
struct Match {
  int left, right;
};

/// Pairs that fulfil the epipolar constraint (A.1), (A.2) -- in a rectified pair: lie on the same
/// row -- and meet within the working depth, at a size that a marker there would have.
class EpipolarMatcher {
 public:
  EpipolarMatcher(const StereoRig& rig, const MatchingOptions& options);

  /// @param points rectified centroids of the blobs, by side
  /// @param matches replaced, ordered by left, then right index
  void match(const std::array<std::vector<Blob>, 2>& blobs,
             const std::array<std::vector<Vec2>, 2>& points, std::vector<Match>& matches);

 private:
  bool size_fits(const Blob& left, const Blob& right, double depth) const;

  StereoRig rig_;
  MatchingOptions options_;
  double pixel_focal_[2];  ///< of the cameras as they are: blobs are measured there
  std::vector<int> by_row_;
};

}  // namespace mocap
}  // namespace anthrob
