#include "anthrob_mocap/pipeline/health.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace anthrob {
namespace mocap {

namespace {

constexpr int kRare = 3;  // sightings in a row without a velocity that are no coincidence
constexpr double kLargestRowError = 0.3;  // [pixel] mean; a rig that has not moved stays below

MatchingOptions rows_only(MatchingOptions options) {
  options.marker_diameter = 0.0;
  options.min_depth = -std::numeric_limits<double>::infinity();
  options.max_depth = std::numeric_limits<double>::infinity();
  return options;
}

}  // namespace

Health::Health(const StereoRig& rig, const MatchingOptions& options)
    : rig_(rig), matcher_(rig, options), row_matcher_(rig, rows_only(options)) {}

void Health::add(const StereoFrame& frame) {
  ++sums_.frames;
  sums_.cluttered += frame.cluttered[kLeft] || frame.cluttered[kRight] ? 1 : 0;
  sums_.cut += frame.cut ? 1 : 0;
  sums_.matches += static_cast<long>(frame.matches.size());
  for (const Side side : {kLeft, kRight}) {
    sums_.blobs[side] += static_cast<long>(frame.blobs[side].size());
  }
  for (const Labelling& labelling : frame.labels) sums_.given_up += labelling.gave_up ? 1 : 0;
  const int before = sums_.poses;
  for (const TargetPose& pose : frame.targets) {
    if (!pose.valid) continue;
    ++sums_.poses;
    sums_.row_error += pose.row_error;
    sums_.pixel_rms += pose.pixel_rms;
  }
  if (sums_.poses == before) try_swapped(frame), try_rows(frame);
  still_.resize(frame.joints.size(), 0);
  for (std::size_t j = 0; j < still_.size(); ++j) {
    const JointEstimate& joint = frame.joints[j];
    if (joint.valid) still_[j] = joint.velocity_valid ? 0 : std::min(still_[j] + 1, kRare);
  }
}

std::vector<std::size_t> Health::joints_without_velocity() const {
  std::vector<std::size_t> result;
  for (std::size_t j = 0; j < still_.size(); ++j) {
    if (still_[j] == kRare) result.push_back(j);
  }
  return result;
}

void Health::try_swapped(const StereoFrame& frame) {
  const std::array<std::vector<Blob>, 2> blobs{frame.blobs[kRight], frame.blobs[kLeft]};
  std::array<std::vector<Vec2>, 2> points;
  for (const Side side : {kLeft, kRight}) {
    for (const Blob& blob : blobs[side]) points[side].push_back(rig_.rectify(side, blob.centre));
  }
  std::vector<Match> matches;
  matcher_.match(blobs, points, matches);
  sums_.matches_if_swapped += static_cast<long>(matches.size());
}

/// Counts left blobs that a right one shares its row with. Lamps are of no marker's size.
void Health::try_rows(const StereoFrame& frame) {
  std::vector<Match> matches;
  row_matcher_.match(frame.blobs, frame.rectified, matches);
  int last = -1;
  for (const Match& match : matches) {
    sums_.on_common_rows += match.left != last ? 1 : 0;
    last = match.left;
  }
}

std::string Health::bend() const {
  if (std::abs(row_error()) <= kLargestRowError) return "";
  char text[128];
  std::snprintf(text, sizeof(text),
                "rows of left and right differ by %.3f pixels: recalibrate the cameras",
                row_error());
  return text;
}

std::string Health::contradiction() const {
  if (sums_.frames == 0 || sums_.poses > 0) return "";
  const long frames = sums_.frames, fewest = std::min(sums_.blobs[kLeft], sums_.blobs[kRight]);
  if (sums_.cluttered == sums_.frames) {
    return "the images are full of bright specks: the scene is too bright, or the threshold too "
           "low";
  }
  if (sums_.matches_if_swapped >= 3 * frames && sums_.matches_if_swapped > 2 * sums_.matches) {
    return "left and right images are swapped";
  }
  if (fewest >= 4 * frames && 4 * sums_.on_common_rows < fewest) {
    return "the blobs of left and right image do not lie on common rows: the "
           "cameras are not synchronised, or the calibration belongs to other cameras";
  }
  return "";
}

std::string Health::advice() const {
  if (sums_.frames == 0 || sums_.poses > 0) return "";
  const std::string why = contradiction();
  if (!why.empty()) return why;
  if (std::min(sums_.blobs[kLeft], sums_.blobs[kRight]) < 3L * sums_.frames) {
    return "hardly any marker is seen: check lighting, threshold and view";
  }
  return "markers are seen but form no target: check targets.yaml, the calibration and what hides "
         "markers";
}

}  // namespace mocap
}  // namespace anthrob
