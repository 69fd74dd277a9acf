#pragma once

#include <vector>

#include "camera/stereo_rig.h"
#include "labelling/clique_search.h"

namespace anthrob {
namespace mocap {

struct PoseOptions {
  double pixel_noise = 0.03;     ///< [pixel] of a centroid, believed before residuals are seen
  double max_turn_sigma = 0.02;  ///< [rad] about any axis; poses less sure are withheld
};

/// Pose of a target in the rectified left frame.
struct TargetPose {
  bool valid = false;
  Pose X;
  int markers = 0;
  double rms = 0.0;                ///< [m] of the triangulated markers about the target
  double pixel_rms = 0.0;          ///< of the centroids about the projected target [pixel]
  double row_error = 0.0;          ///< mean of v_left - v_right over the markers [pixel]
  Mat6 covariance = Mat6::Zero();  ///< of (p, turn), both in the camera's axes [m, rad]
};

/// Pose from labelled markers: Umeyama's closed form from the points in space, then Gauss-Newton on
/// the centroids in both images. That matters because depth is measured some ten times worse than
/// the rest, and the closed form weighs all directions alike. The normal equations give the
/// covariance. Of four markers or more, one that does not fit (merged with a reflection, half
/// hidden) is left out.
class PoseEstimator {
 public:
  PoseEstimator(const StereoRig& rig, const std::vector<MarkerTarget>& targets,
                const PoseOptions& options)
      : rig_(rig), targets_(targets), options_(options) {}

  TargetPose estimate(int target, const Labelling& labelling,
                      const std::vector<MarkerPoint>& points) const;

 private:
  struct Observation {
    Vec3 marker;              ///< in the target's frame
    const MarkerPoint* seen;  ///< where it was seen
  };
  struct Observations {
    Observation list[PointPairs::kMost];
    int count = 0;
  };
  struct Normal {
    Mat6 H;
    Eigen::Matrix<double, 6, 1> g;
    double squares;  ///< of the reprojection error [rectified pixel^2]
    int worst;       ///< marker that fits worst
  };
  Normal normal_equations(const Observations& markers, const Pose& X) const;
  Normal refine(const Observations& markers, Pose& X) const;
  double pixel_rms(const Normal& normal, int markers) const;
  void describe(const Observations& markers, const Normal& normal, TargetPose& pose) const;

  StereoRig rig_;
  std::vector<MarkerTarget> targets_;
  PoseOptions options_;
};

}  // namespace mocap
}  // namespace anthrob
