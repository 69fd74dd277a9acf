#include "pipeline/health.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace anthrob {
namespace mocap {

namespace {

constexpr int kRare = 3;  // sightings in a row without a velocity before a joint is reported
// Limits in pixels of the cameras, as TargetPose has them.
constexpr double kLargestRowError = 0.3;  // [pixel] mean; above it the rig has certainly moved
// [pixel] root mean square, of rows and of residuals. A sound rig shows the noise of its centroids:
// in virtual pictures 0.005, of dim markers 0.015. A camera turned by 0.05 degrees along the rows
// gives 0.13 to 0.15 and angles that are off by 0.2 degrees.
constexpr double kNoiseFactor = 3.0;   // [1] times the noise; chance reaches it once in 300 rows
constexpr double kLeastLimit = 0.05;   // [pixel] what calibrations of cameras and targets leave
constexpr double kLargestLimit = 0.2;  // [pixel] above it angles are wrong, noise or not
constexpr int kFewestPoses = 5;        // of a target; fewer may be one merged blob

std::string format(const char* form, double value) {
  char text[160];
  std::snprintf(text, sizeof(text), form, value);
  return text;
}

/// Left blobs that have a match or more; matches are in the order of these blobs.
long matched_blobs(const std::vector<Match>& matches) {
  long count = 0;
  int last = -1;
  for (const Match& match : matches) {
    count += match.left != last ? 1 : 0;
    last = match.left;
  }
  return count;
}

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
  if (frame.fault) return;  // nothing was seen because nobody looked
  ++sums_.frames;
  sums_.cluttered += frame.cluttered[kLeft] || frame.cluttered[kRight] ? 1 : 0;
  sums_.cut += frame.cut ? 1 : 0;
  for (const Side side : {kLeft, kRight}) {
    sums_.blobs[side] += static_cast<long>(frame.blobs[side].size());
  }
  for (const Labelling& labelling : frame.labels) sums_.given_up += labelling.gave_up ? 1 : 0;
  const int before = sums_.poses;
  sums_.targets.resize(frame.targets.size());
  for (std::size_t k = 0; k < frame.targets.size(); ++k) {
    const TargetPose& pose = frame.targets[k];
    if (!pose.valid) continue;
    ++sums_.poses;
    sums_.row_error += pose.row_error;
    sums_.pixel_rms += pose.pixel_rms;
    add_change(pose, sums_.targets[k]);
    ++sums_.targets[k].poses;
    sums_.targets[k].rows += pose.row_error;
    sums_.targets[k].row_error += pose.row_error * pose.row_error;
    sums_.targets[k].pixel_rms += pose.pixel_rms * pose.pixel_rms;
  }
  if (sums_.poses == before) {
    // The matches of a picture that was cut cannot be compared with those of the swapped one.
    if (!frame.cut) try_swapped(frame);
    try_rows(frame);
  }
  still_.resize(frame.joints.size(), 0);
  sums_.joints.resize(frame.joints.size(), 0);
  for (std::size_t j = 0; j < still_.size(); ++j) {
    const JointEstimate& joint = frame.joints[j];
    sums_.joints[j] += joint.valid ? 1 : 0;
    if (joint.valid) still_[j] = joint.velocity_valid ? 0 : std::min(still_[j] + 1, kRare);
  }
}

/// A row error is the mean of v_left - v_right over m markers, each of variance 2 s^2; so the
/// square of the difference of two has the mean 4 s^2 / m.
void Health::add_change(const TargetPose& pose, Squares& target) {
  if (target.last_row && target.last_markers == pose.markers) {
    sums_.variance += std::pow(pose.row_error - *target.last_row, 2) * pose.markers / 4.0;
    ++sums_.changes;
  }
  target.last_row = pose.row_error;
  target.last_markers = pose.markers;
}

double Health::noise() const {
  return sums_.changes > 0 ? std::sqrt(sums_.variance / sums_.changes) : 0.0;
}

double Health::limit() const {
  return std::clamp(kNoiseFactor * noise(), kLeastLimit, kLargestLimit);
}

std::vector<std::size_t> Health::unseen_targets() const {
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < sums_.targets.size(); ++k) {
    if (sums_.targets[k].poses == 0) result.push_back(k);
  }
  return result;
}

std::vector<std::size_t> Health::unseen_joints() const {
  std::vector<std::size_t> result;
  for (std::size_t j = 0; j < sums_.joints.size(); ++j) {
    if (sums_.joints[j] == 0) result.push_back(j);
  }
  return result;
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
  ++sums_.tried_swapped;
  sums_.matches += static_cast<long>(frame.matches.size());
  sums_.matches_if_swapped += static_cast<long>(matches.size());
  sums_.matched_if_swapped += matched_blobs(matches);
  sums_.fewer_blobs += static_cast<long>(std::min(blobs[kLeft].size(), blobs[kRight].size()));
}

/// Counts the left blobs that have a right blob on their row, at any depth and of any size: lamps
/// are not as large as markers.
void Health::try_rows(const StereoFrame& frame) {
  std::vector<Match> matches;
  row_matcher_.match(frame.blobs, frame.rectified, matches);
  sums_.on_common_rows += matched_blobs(matches);
}

double Health::residual(std::size_t target) const {
  if (target >= sums_.targets.size() || sums_.targets[target].poses == 0) return 0.0;
  return std::sqrt(sums_.targets[target].pixel_rms / sums_.targets[target].poses);
}

/// The largest root mean square of all targets.
double Health::worst(double Squares::*sum) const {
  double largest = 0.0;
  for (const Squares& target : sums_.targets) {
    if (target.poses < kFewestPoses) continue;
    largest = std::max(largest, std::sqrt(target.*sum / target.poses));
  }
  return largest;
}

/// Over all targets with enough poses.
double Health::mean_of_rows() const {
  double sum = 0.0;
  int poses = 0;
  for (const Squares& target : sums_.targets) {
    if (target.poses < kFewestPoses) continue;
    sum += target.rows;
    poses += target.poses;
  }
  return poses > 0 ? sum / poses : 0.0;
}

std::optional<std::string> Health::uneven_rows() const {
  const double mean = mean_of_rows();
  if (std::abs(mean) > kLargestRowError) {
    return format("rows of left and right differ by %.3f pixels: recalibrate the cameras", mean);
  }
  const double rms = worst(&Squares::row_error);
  if (rms <= limit()) return std::nullopt;
  return format(
      "rows of left and right differ by %.3f pixels rms: the rig has been bent, or the pair is not "
      "synchronised",
      rms);
}

std::optional<std::string> Health::bend() const {
  const double rms = worst(&Squares::pixel_rms);
  const auto rows = uneven_rows();
  if (rms <= limit() || (rows && worst(&Squares::row_error) > rms)) return rows;
  return format(
      "markers are %.3f pixels rms off their target: the rig has been bent, the pair is not "
      "synchronised, or the target is not calibrated",
      rms);
}

std::optional<std::string> Health::crowd() const {
  if (sums_.cut == 0) return std::nullopt;
  return std::to_string(sums_.cut) + " of " + std::to_string(sums_.frames) +
         " pairs show more points than most_points: the lowest in the picture are ignored, and "
         "three markers make no pose; cover reflections, or raise the threshold";
}

std::optional<std::string> Health::contradiction() const {
  if (sums_.frames == 0 || sums_.poses > 0) return std::nullopt;
  const long frames = sums_.frames, fewest = std::min(sums_.blobs[kLeft], sums_.blobs[kRight]);
  if (sums_.cluttered == sums_.frames) {
    return "the images are full of bright specks: the scene is too bright, or the threshold too "
           "low";
  }
  // Swapped back, nearly all blobs have a match, of 10 to 40 at least 94 %. With a camera that was
  // pitched or rolled, chance gives up to 36 % of them one.
  if (sums_.tried_swapped > 0 && sums_.matches_if_swapped >= 3L * sums_.tried_swapped &&
      sums_.matches_if_swapped > 2 * sums_.matches &&
      2 * sums_.matched_if_swapped > sums_.fewer_blobs) {
    return "left and right images are swapped";
  }
  if (fewest >= 4 * frames && 4 * sums_.on_common_rows < fewest) {
    return "the blobs of left and right image do not lie on common rows: the "
           "cameras are not synchronised, or the calibration belongs to other cameras";
  }
  return std::nullopt;
}

std::optional<std::string> Health::advice() const {
  if (sums_.frames == 0 || sums_.poses > 0) return std::nullopt;
  if (auto why = contradiction()) return why;
  if (2 * sums_.cut > sums_.frames) return crowd();
  if (std::min(sums_.blobs[kLeft], sums_.blobs[kRight]) < 3L * sums_.frames) {
    return "hardly any marker is seen: check lighting, threshold and view";
  }
  return "markers are seen but form no target: check targets.yaml, the calibration and what hides "
         "markers";
}

}  // namespace mocap
}  // namespace anthrob
