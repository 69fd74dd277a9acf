#include "calibration/target_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anthrob_core/errors.h"
#include "labelling/clique_search.h"

namespace anthrob {
namespace mocap {

namespace {

constexpr double kGuessError = 0.02;    // [m] of edges measured by hand
constexpr double kLargestRms = 0.0015;  // [m] beyond it something is loose
constexpr int kFewestFrames = 20;       // in which a marker must be seen
constexpr int kRounds = 10;
/// [m] from the guess. Guesses that are off by up to 10 mm along each axis come out within 18 mm.
constexpr double kLargestMove = 0.02;
/// Largest ratio of the residuals with the mirrored and with the given guess at which a target is
/// taken for mirrored. With guesses that are off by up to 10 mm along each axis, the smallest ratio
/// in 3000 draws was 0.46 (four markers, one of them 20 mm out of the plane of the others), so that
/// hardly any of them is refused.
constexpr double kMirrored = 0.5;

std::string in_mm(double metres, int decimals) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.*f", decimals, 1e3 * metres);
  return text;
}

/// One round: means of all frames, each brought onto the target as known.
class Mean {
 public:
  explicit Mean(const MarkerTarget& target)
      : target_(target),
        sum_(target.markers.size(), Vec3::Zero()),
        squares_(target.markers.size(), 0.0),
        seen_(target.markers.size(), 0) {}

  void add(const Labelling& labelling, const std::vector<MarkerPoint>& points) {
    ++frames_;
    const Pose X_TC = labelling.fit.X.inverse();
    for (std::size_t i = 0; i < sum_.size(); ++i) {
      if (labelling.point[i] < 0) continue;
      const Vec3 m = X_TC * points[static_cast<std::size_t>(labelling.point[i])].p;
      sum_[i] += m, ++seen_[i];
      squares_[i] += (m - target_.markers[i]).squaredNorm();
    }
  }
  TargetCalibration result() const {
    TargetCalibration result{target_, frames_, std::vector<double>(sum_.size(), 0.0), seen_};
    for (std::size_t i = 0; i < sum_.size(); ++i) {
      if (seen_[i] == 0) continue;
      result.target.markers[i] = sum_[i] / seen_[i];
      result.rms[i] = std::sqrt(squares_[i] / seen_[i]);
    }
    return result;
  }

 private:
  const MarkerTarget& target_;
  std::vector<Vec3> sum_;
  std::vector<double> squares_;
  std::vector<int> seen_;
  int frames_ = 0;
};

TargetCalibration round(const MarkerTarget& target, double tolerance,
                        const std::vector<std::vector<MarkerPoint>>& frames) {
  LabellingOptions options;
  options.edge_tolerance = tolerance;
  options.rms_tolerance = options.triple_tolerance = tolerance;
  CliqueSearch search(target, options);
  Mean mean(target);
  std::vector<Edge> edges;
  for (const std::vector<MarkerPoint>& points : frames) {
    find_edges(points, search.longest_edge() + tolerance, edges);
    const Labelling& labelling = search.find(points, edges, std::vector<char>(points.size(), 1));
    // Three markers alone are too uncertain while the target is not known well.
    if (labelling.count >= std::min<int>(4, static_cast<int>(target.markers.size())) &&
        !labelling.ambiguous && !labelling.gave_up) {
      mean.add(labelling, points);
    }
  }
  return mean.result();
}

RigidFit fit(const MarkerTarget& from, const MarkerTarget& to) {
  PointPairs pairs;
  for (std::size_t i = 0; i < to.markers.size(); ++i) pairs.add(from.markers[i], to.markers[i]);
  return fit_rigid(pairs);
}

/// Brings the markers back onto the guess: the rounds may have drifted as a whole.
/// @throws BadInput if they do not resemble the guess, or resemble its mirror image. Pictures that
///   are flipped, those of the checkerboard too, mirror a target and keep its distances
void anchor(const MarkerTarget& guess, MarkerTarget& target) {
  const RigidFit direct = fit(target, guess);
  MarkerTarget mirror = guess;
  for (Vec3& m : mirror.markers) m.x() = -m.x();
  if (direct.rms > kLargestRms && fit(target, mirror).rms < kMirrored * direct.rms) {
    throw BadInput("target " + guess.name +
                   ": the markers come out mirrored: is an image flipped? Expected pictures as the "
                   "cameras take them, for the calibration of the cameras, too");
  }
  for (std::size_t i = 0; i < target.markers.size(); ++i) {
    target.markers[i] = direct.X * target.markers[i];
    const double move = (target.markers[i] - guess.markers[i]).norm();
    if (move <= kLargestMove) continue;
    throw BadInput("target " + guess.name + ": marker " + std::to_string(i) + " comes out " +
                   in_mm(move, 1) + " mm from where it was measured: expected at most " +
                   in_mm(kLargestMove, 0) +
                   " mm; measure it again, and check that no image is flipped");
  }
}

}  // namespace

TargetCalibration calibrate_target(const MarkerTarget& guess,
                                   const std::vector<std::vector<MarkerPoint>>& frames) {
  TargetCalibration result;
  result.target = guess;
  double tolerance = kGuessError;
  for (int i = 0; i < kRounds; ++i) {
    result = round(result.target, tolerance, frames);
    if (i > 1) tolerance = 2.0 * kLargestRms;
  }
  for (std::size_t i = 0; i < result.seen.size(); ++i) {
    if (result.seen[i] >= kFewestFrames) continue;
    throw BadInput("target " + guess.name + ": marker " + std::to_string(i) + " was seen in " +
                   std::to_string(result.seen[i]) + " frames: expected at least " +
                   std::to_string(kFewestFrames) +
                   "; check that its position was measured to a centimetre, and that both cameras "
                   "see it together with three others (two in a target of three)");
  }
  const auto worst = std::max_element(result.rms.begin(), result.rms.end());
  if (!(*worst <= kLargestRms)) {
    throw BadInput("target " + guess.name + ": marker " +
                   std::to_string(worst - result.rms.begin()) + " scatters by " +
                   std::to_string(1e3 * *worst) + " mm: expected at most " +
                   std::to_string(1e3 * kLargestRms) + "; check that it is fixed to the link");
  }
  anchor(guess, result.target);
  return result;
}

}  // namespace mocap
}  // namespace anthrob
