#pragma once

#include <string>
#include <vector>

#include "anthrob_mocap/pipeline/stereo_frame.h"

namespace anthrob {
namespace mocap {

/// Judges from a series of frames whether rig, calibration and targets belong together.
class Health {
 public:
  Health(const StereoRig& rig, const MatchingOptions& options);

  void add(const StereoFrame& frame);
  void clear() { sums_ = Sums(); }  ///< keeps the state of joints_without_velocity

  int frames() const { return sums_.frames; }
  int poses() const { return sums_.poses; }
  int given_up() const { return sums_.given_up; }  ///< searches of targets that reached step_limit
  int cut() const { return sums_.cut; }            ///< frames with more matches than most_points
  /// Mean of v_left - v_right over the markers used [pixel]; far from 0: the rig has moved.
  double row_error() const { return sums_.poses > 0 ? sums_.row_error / sums_.poses : 0.0; }
  double pixel_rms() const { return sums_.poses > 0 ? sums_.pixel_rms / sums_.poses : 0.0; }

  /// Joints that were seen three times in a row or more, but never twice within
  /// JointEstimator::kLongestGap: they have no velocity and are not published. Pictures are too
  /// rare, or their stamps are wrong.
  std::vector<std::size_t> joints_without_velocity() const;

  /// Says that the rig seems to be bent a little: there are poses, but rows differ; else empty.
  std::string bend() const;
  /// What is certainly wrong with the images or the calibration; empty if nothing is.
  std::string contradiction() const;
  /// What to check if no target was found; empty if one was.
  std::string advice() const;

 private:
  struct Sums {
    int frames = 0, poses = 0, cluttered = 0, cut = 0, given_up = 0;
    long matches = 0, matches_if_swapped = 0, on_common_rows = 0, blobs[2] = {0, 0};
    double row_error = 0.0, pixel_rms = 0.0;
  };
  void try_swapped(const StereoFrame& frame);
  void try_rows(const StereoFrame& frame);

  StereoRig rig_;
  EpipolarMatcher matcher_, row_matcher_;  ///< the latter at any depth, of any size
  Sums sums_;
  std::vector<int> still_;  ///< by joint: pictures in a row in which it had no velocity
};

}  // namespace mocap
}  // namespace anthrob
