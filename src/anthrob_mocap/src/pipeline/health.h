#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/stereo_frame.h"

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

  /// Targets without any pose, and joints without any orientation. Indices; none without frames.
  std::vector<std::size_t> unseen_targets() const;
  std::vector<std::size_t> unseen_joints() const;
  /// Joints that were seen three times in a row or more, but never twice within
  /// JointEstimator::kLongestGap: they have no velocity and are not published. Pictures are too
  /// rare, or their stamps are wrong.
  std::vector<std::size_t> joints_without_velocity() const;

  /// Standard deviation of a centroid [pixel], from how row errors change from pose to pose: what a
  /// bent rig adds to them hardly changes. 0 before two poses.
  double noise() const;

  /// Says that rows of left and right differ, though targets are found; else none. Does not depend
  /// on where the markers of the targets are.
  std::optional<std::string> uneven_rows() const;
  /// uneven_rows, or that the markers do not fit the targets: the rig has been bent or the pair is
  /// not synchronised, so angles are wrong. For targets that are calibrated; else none.
  std::optional<std::string> bend() const;
  /// Says that pictures were cut at most_points; else none.
  std::optional<std::string> crowd() const;
  /// Root mean square of pixel_rms over the poses of a target [pixel]; 0 without poses.
  double residual(std::size_t target) const;
  /// What is certainly wrong with the images or the calibration; none if nothing is.
  std::optional<std::string> contradiction() const;
  /// What to check if no target was found; none if one was.
  std::optional<std::string> advice() const;

 private:
  /// Of one target. A movement to and fro shows in the squares, not in the mean.
  struct Squares {
    int poses = 0;
    double row_error = 0.0, pixel_rms = 0.0;  ///< sums of squares
    double rows = 0.0;                        ///< sum of row errors, with their signs
    std::optional<double> last_row;           ///< row error of the last pose,
    int last_markers = 0;                     ///< and what it was the mean of
  };
  struct Sums {
    int frames = 0, poses = 0, cluttered = 0, cut = 0, given_up = 0;
    int tried_swapped = 0;                     ///< frames that were matched with sides swapped, too
    long matches = 0, matches_if_swapped = 0;  ///< in these frames
    /// In these frames: blobs of the side that shows fewer, and how many have a match if swapped.
    long fewer_blobs = 0, matched_if_swapped = 0;
    long on_common_rows = 0, blobs[2] = {0, 0};
    double row_error = 0.0, pixel_rms = 0.0;
    double variance = 0.0;  ///< sum of what each change says of a centroid's [pixel^2]
    int changes = 0;        ///< of row errors, between poses of as many markers
    std::vector<Squares> targets;
    std::vector<int> joints;  ///< frames with an orientation
  };
  double worst(double Squares::*sum) const;
  double mean_of_rows() const;
  double limit() const;
  void add_change(const TargetPose& pose, Squares& target);
  void try_swapped(const StereoFrame& frame);
  void try_rows(const StereoFrame& frame);

  StereoRig rig_;
  EpipolarMatcher matcher_, row_matcher_;  ///< the latter at any depth, of any size
  Sums sums_;
  std::vector<int> still_;  ///< by joint: pictures in a row in which it had no velocity
};

}  // namespace mocap
}  // namespace anthrob
