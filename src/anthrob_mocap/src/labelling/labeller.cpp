#include "anthrob_mocap/labelling/labeller.h"

#include <algorithm>
#include <numeric>

namespace anthrob {
namespace mocap {

Labeller::Labeller(const std::vector<MarkerTarget>& targets, const LabellingOptions& options,
                   const MotionOptions& motion)
    : priors_(targets.size(), MotionPrior(motion)), order_(targets.size()) {
  for (const MarkerTarget& target : targets) {
    searches_.emplace_back(target, options);
    longest_ = std::max(longest_, searches_.back().longest_edge() + options.edge_tolerance);
  }
}

void Labeller::label(double t, const std::vector<MarkerPoint>& points,
                     const std::vector<Edge>& edges, std::vector<Labelling>& result) {
  result.resize(searches_.size());
  usable_.assign(points.size(), 1);
  for (std::size_t k = 0; k < searches_.size(); ++k) {
    result[k] = searches_[k].find(points, edges, usable_);
  }
  // The surest first; whoever comes later and wants the same blobs has to look again.
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
    return result[a].count != result[b].count ? result[a].count > result[b].count
                                              : result[a].fit.rms < result[b].fit.rms;
  });
  for (const std::size_t k : order_) {
    Labelling& labelling = result[k];
    if (collides(labelling)) labelling = searches_[k].find(points, edges, usable_);
    const bool doubtful =
        labelling.ambiguous ||
        (labelling.count == 3 && (labelling.gave_up || priors_[k].contradicts(t, labelling.fit.X)));
    if (doubtful) labelling.count = 0;
    if (labelling.count == 0) continue;
    priors_[k].accept(t, labelling.fit.X);
    withdraw_used(labelling, points);
  }
}

bool Labeller::collides(const Labelling& labelling) const {
  if (labelling.count == 0) return false;
  return std::any_of(labelling.point.begin(), labelling.point.end(), [&](int point) {
    return point >= 0 && !usable_[static_cast<std::size_t>(point)];
  });
}

void Labeller::withdraw_used(const Labelling& labelling, const std::vector<MarkerPoint>& points) {
  for (const int used : labelling.point) {
    if (used < 0) continue;
    const MarkerPoint& marker = points[static_cast<std::size_t>(used)];
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].blob[kLeft] == marker.blob[kLeft] ||
          points[i].blob[kRight] == marker.blob[kRight]) {
        usable_[i] = 0;
      }
    }
  }
}

}  // namespace mocap
}  // namespace anthrob
