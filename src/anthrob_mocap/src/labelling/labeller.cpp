#include "labelling/labeller.h"

#include <algorithm>
#include <numeric>

namespace anthrob {
namespace mocap {

namespace {

/// Among more points than these, three markers are not believed. N points at random in a view of
/// volume V give about M N^3 8 pi^2 r^3 w / V^2 triples that fit by chance: M = 10 triples of five
/// markers, r = 0.1 m their edges, w = 7e-9 m^3 the differences of edges that triple_tolerance
/// allows. With V = 0.2 m^3 that is 0.002 by picture for 25 points, 0.02 for 50, and 0.1 for 100.
constexpr std::size_t kCrowd = 50;

}  // namespace

Labeller::Labeller(const std::vector<MarkerTarget>& targets, const LabellingOptions& options,
                   const MotionOptions& motion)
    : options_(options) {
  for (const MarkerTarget& target : targets) {
    searches_.emplace_back(target, options);
    priors_.emplace_back(motion, target.centre());
    longest_ = std::max(longest_, searches_.back().longest_edge() + options.edge_tolerance);
  }
}

void Labeller::label(double t, const std::vector<MarkerPoint>& points, bool cut,
                     const std::vector<Edge>& edges, std::vector<Labelling>& result) {
  const bool crowd = cut || points.size() > kCrowd;
  result.resize(searches_.size());
  usable_.assign(points.size(), 1);
  open_.resize(searches_.size());
  std::iota(open_.begin(), open_.end(), std::size_t{0});
  for (const std::size_t k : open_) result[k] = searches_[k].find(points, edges, usable_);
  while (!open_.empty()) {
    // First the labelling of most markers, then of the best fit. Targets that want the same blobs
    // are searched again without them.
    const auto surest =
        std::min_element(open_.begin(), open_.end(), [&](std::size_t a, std::size_t b) {
          return result[a].count != result[b].count ? result[a].count > result[b].count
                                                    : result[a].fit.rms < result[b].fit.rms;
        });
    const std::size_t k = *surest;
    open_.erase(surest);
    Labelling& labelling = result[k];
    const bool doubtful = contested(labelling, points, result) || labelling.ambiguous ||
                          (labelling.count == 3 && (crowd || labelling.gave_up ||
                                                    priors_[k].contradicts(t, labelling.fit.X)));
    if (doubtful) labelling.count = 0;
    if (labelling.count == 0) continue;
    priors_[k].accept(t, labelling.fit.X);
    withdraw_used(labelling, points);
    for (const std::size_t other : open_) {
      // An ambiguous target may have a single labelling among the remaining blobs.
      if (!result[other].ambiguous && !collides(result[other])) continue;
      result[other] = searches_[other].find(points, edges, usable_);
    }
  }
}

/// Whether targets that are not decided yet fit the same blobs equally well. Then it is unknown to
/// which of them the blobs belong, and none of these targets is found.
bool Labeller::contested(const Labelling& labelling, const std::vector<MarkerPoint>& points,
                         std::vector<Labelling>& result) {
  const std::size_t before = open_.size();
  const auto claims = [&](std::size_t other) {
    Labelling& claim = result[other];
    if (!labelling.ties_with(claim, options_) || !share_blobs(labelling, claim, points)) {
      return false;
    }
    claim.count = 0;
    return true;
  };
  open_.erase(std::remove_if(open_.begin(), open_.end(), claims), open_.end());
  return open_.size() < before;
}

bool Labeller::collides(const Labelling& labelling) const {
  if (labelling.count == 0) return false;
  return std::any_of(labelling.point.begin(), labelling.point.end(), [&](int point) {
    return point >= 0 && !usable_[static_cast<std::size_t>(point)];
  });
}

namespace {

bool share_blob(const MarkerPoint& a, const MarkerPoint& b) {
  return a.blob[kLeft] == b.blob[kLeft] || a.blob[kRight] == b.blob[kRight];
}

}  // namespace

bool Labeller::share_blobs(const Labelling& a, const Labelling& b,
                           const std::vector<MarkerPoint>& points) {
  for (const int i : a.point) {
    for (const int j : b.point) {
      if (i >= 0 && j >= 0 &&
          share_blob(points[static_cast<std::size_t>(i)], points[static_cast<std::size_t>(j)])) {
        return true;
      }
    }
  }
  return false;
}

void Labeller::withdraw_used(const Labelling& labelling, const std::vector<MarkerPoint>& points) {
  for (const int used : labelling.point) {
    if (used < 0) continue;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (share_blob(points[static_cast<std::size_t>(used)], points[i])) usable_[i] = 0;
    }
  }
}

}  // namespace mocap
}  // namespace anthrob
