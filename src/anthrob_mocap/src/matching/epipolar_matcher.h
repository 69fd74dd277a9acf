#pragma once

#include <array>
#include <vector>

#include "camera/stereo_rig.h"
#include "segmentation/blob.h"

namespace anthrob {
namespace mocap {

struct MatchingOptions {
  double epipolar_tolerance = 1.0;  ///< delta of (A.2) [pixel]
  double min_depth = 0.15;          ///< [m]
  double max_depth = 6.0;           ///< [m]
  double marker_diameter = 0.0;     ///< [m]; 0: sizes are not checked
  double size_factor = 2.0;  ///< largest ratio of a blob's radius to a marker's there, either way
};

/// A blob of each image that could show the same marker.
struct Match {
  int left, right;
};

/// Matches blobs of the two images that fulfil the epipolar constraint (A.1), (A.2): in a rectified
/// pair they lie on the same row. The point in space must be within the working depth, and both
/// blobs about as large as a marker at that depth.
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
  double pixel_focal_[2];  ///< of the cameras before rectification, where blobs are measured
  std::vector<int> by_row_;
};

}  // namespace mocap
}  // namespace anthrob
