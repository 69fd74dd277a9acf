#include "matching/epipolar_matcher.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace mocap {

EpipolarMatcher::EpipolarMatcher(const StereoRig& rig, const MatchingOptions& options)
    : rig_(rig), options_(options) {
  for (const Side side : {kLeft, kRight}) {
    pixel_focal_[side] = std::sqrt(rig.camera(side).fx * rig.camera(side).fy);
  }
}

void EpipolarMatcher::match(const std::array<std::vector<Blob>, 2>& blobs,
                            const std::array<std::vector<Vec2>, 2>& points,
                            std::vector<Match>& matches) {
  matches.clear();
  const double tolerance = options_.epipolar_tolerance * rig_.zoom();
  const std::vector<Vec2>& right = points[kRight];
  by_row_.clear();
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (right[i].allFinite()) by_row_.push_back(static_cast<int>(i));
  }
  std::sort(by_row_.begin(), by_row_.end(), [&](int a, int b) {
    const double va = right[static_cast<std::size_t>(a)].y();
    const double vb = right[static_cast<std::size_t>(b)].y();
    return va != vb ? va < vb : a < b;
  });
  for (std::size_t l = 0; l < points[kLeft].size(); ++l) {
    const Vec2& left = points[kLeft][l];
    const auto first = std::lower_bound(
        by_row_.begin(), by_row_.end(), left.y() - tolerance,
        [&](int index, double v) { return right[static_cast<std::size_t>(index)].y() < v; });
    const std::size_t begin = matches.size();
    for (auto it = first; it != by_row_.end(); ++it) {
      const std::size_t r = static_cast<std::size_t>(*it);
      if (right[r].y() > left.y() + tolerance) break;
      const double depth = rig_.focal() * rig_.baseline() / rig_.disparity(left, right[r]);
      if (!(depth >= options_.min_depth && depth <= options_.max_depth) ||
          !size_fits(blobs[kLeft][l], blobs[kRight][r], depth)) {
        continue;
      }
      matches.push_back({static_cast<int>(l), static_cast<int>(r)});
    }
    std::sort(matches.begin() + static_cast<std::ptrdiff_t>(begin), matches.end(),
              [](const Match& a, const Match& b) { return a.right < b.right; });
  }
}

bool EpipolarMatcher::size_fits(const Blob& left, const Blob& right, double depth) const {
  if (options_.marker_diameter <= 0.0) return true;
  // A pixel of slack: where the threshold cuts the blurred edge is not known.
  const auto fits = [&](const Blob& blob, Side side) {
    const double expected = 0.5 * options_.marker_diameter * pixel_focal_[side] / depth;
    const double radius = blob.radius();
    return radius <= expected * options_.size_factor + 1.0 &&
           radius >= expected / options_.size_factor - 1.0;
  };
  return fits(left, kLeft) && fits(right, kRight);
}

}  // namespace mocap
}  // namespace anthrob
