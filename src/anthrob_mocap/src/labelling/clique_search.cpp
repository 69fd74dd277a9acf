#include "labelling/clique_search.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace mocap {

namespace {

constexpr int kFewest = 3;  // markers that make a pose

}  // namespace

CliqueSearch::CliqueSearch(const MarkerTarget& target, const LabellingOptions& options)
    : target_(target), centre_(target.centre()), options_(options) {
  const int count = static_cast<int>(target.markers.size());
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      const double length = (target.markers[static_cast<std::size_t>(i)] -
                             target.markers[static_cast<std::size_t>(j)])
                                .norm();
      reference_.push_back({i, j, length});
      longest_ = std::max(longest_, length);
    }
  }
  assigned_.resize(target.markers.size());
}

CliqueSearch::Word* CliqueSearch::links(int marker, int point, int other_marker) {
  const int markers = static_cast<int>(target_.markers.size());
  return &links_[static_cast<std::size_t>(
      ((marker * point_count_ + point) * markers + other_marker) * words_)];
}

CliqueSearch::Word* CliqueSearch::allowed(int level, int marker) {
  const int markers = static_cast<int>(target_.markers.size());
  return &allowed_[static_cast<std::size_t>((level * markers + marker) * words_)];
}

bool CliqueSearch::any(const Word* set) const {
  return std::any_of(set, set + words_, [](Word word) { return word != 0; });
}

const Labelling& CliqueSearch::find(const std::vector<MarkerPoint>& points,
                                    const std::vector<Edge>& edges,
                                    const std::vector<char>& usable) {
  best_.count = rival_.count = 0, best_.ambiguous = false;
  mirrored_count_ = 0, steps_ = 0;
  if (points.size() >= static_cast<std::size_t>(kFewest)) {
    build(points, edges, usable);
    descend(0, 0);
  }
  best_.ambiguous = best_.ties_with(rival_, options_);
  best_.gave_up = steps_ > options_.step_limit;
  return best_;
}

/// The correspondence graph: bit b of links(i, a, j) says that marker i at point a goes with marker
/// j at point b.
void CliqueSearch::build(const std::vector<MarkerPoint>& points, const std::vector<Edge>& edges,
                         const std::vector<char>& usable) {
  const int markers = static_cast<int>(target_.markers.size());
  points_ = &points;
  point_count_ = static_cast<int>(points.size());
  words_ = (point_count_ + 63) / 64;
  links_.assign(static_cast<std::size_t>(markers * point_count_ * markers * words_), 0);
  allowed_.assign(static_cast<std::size_t>((markers + 1) * markers * words_), 0);
  const auto set = [](Word* bits, int bit) { bits[bit / 64] |= Word{1} << (bit % 64); };
  for (const ReferenceEdge& r : reference_) {
    auto edge = std::lower_bound(
        edges.begin(), edges.end(), r.length - options_.edge_tolerance,
        [](const Edge& candidate, double length) { return candidate.length < length; });
    for (; edge != edges.end() && edge->length <= r.length + options_.edge_tolerance; ++edge) {
      if (!usable[static_cast<std::size_t>(edge->a)] || !usable[static_cast<std::size_t>(edge->b)])
        continue;
      for (const auto& [a, b] : {std::pair{edge->a, edge->b}, std::pair{edge->b, edge->a}}) {
        set(links(r.i, a, r.j), b), set(links(r.j, b, r.i), a);
        set(allowed(0, r.i), a), set(allowed(0, r.j), b);
      }
    }
  }
}

void CliqueSearch::descend(int level, int chosen) {
  const int markers = static_cast<int>(target_.markers.size());
  if (level == markers) {
    judge(chosen);
    return;
  }
  if (++steps_ > options_.step_limit) return;
  int possible = chosen;
  for (int j = level; j < markers; ++j) possible += any(allowed(level, j)) ? 1 : 0;
  if (possible < std::max(kFewest, best_.count)) return;

  for (int word = 0; word < words_; ++word) {
    for (Word bits = allowed(level, level)[word]; bits != 0; bits &= bits - 1) {
      const int point = word * 64 + __builtin_ctzll(bits);
      for (int j = level + 1; j < markers; ++j) {
        const Word *before = allowed(level, j), *link = links(level, point, j);
        Word* after = allowed(level + 1, j);
        for (int w = 0; w < words_; ++w) after[w] = before[w] & link[w];
      }
      assigned_[static_cast<std::size_t>(level)] = point;
      descend(level + 1, chosen + 1);
    }
  }
  // The other possibility: this marker is not seen.
  for (int j = level + 1; j < markers; ++j) {
    std::copy_n(allowed(level, j), words_, allowed(level + 1, j));
  }
  assigned_[static_cast<std::size_t>(level)] = -1;
  descend(level + 1, chosen);
}

void CliqueSearch::judge(int chosen) {
  if (chosen < std::max(kFewest, best_.count)) return;
  PointPairs pairs;
  for (std::size_t i = 0; i < assigned_.size(); ++i) {
    if (assigned_[i] < 0) continue;
    pairs.add(target_.markers[i], (*points_)[static_cast<std::size_t>(assigned_[i])].p);
  }
  const RigidFit fit = fit_rigid(pairs);
  if (chosen > kFewest && fit.rms > 3.0 * options_.edge_tolerance) {
    // The distances fit but the shape does not: a mirror image. Triples of its points are refused,
    // too.
    if (mirrored_.size() == mirrored_count_) mirrored_.emplace_back();
    mirrored_[mirrored_count_++] = assigned_;
    return;
  }
  if (fit.rms > (chosen > kFewest ? options_.rms_tolerance : options_.triple_tolerance) ||
      mirrored(chosen)) {
    return;
  }
  const auto remember = [&](Labelling& labelling) {
    labelling.point = assigned_, labelling.count = chosen, labelling.fit = fit;
  };
  if (chosen > best_.count) {
    remember(best_);
    rival_.count = 0;
  } else if (fit.rms < best_.fit.rms) {
    if (differ(fit.X, best_.fit.X)) std::swap(rival_, best_);
    remember(best_);
  } else if (differ(fit.X, best_.fit.X) && (rival_.count < chosen || fit.rms < rival_.fit.rms)) {
    remember(rival_);
  }
}

/// Whether two poses are too far apart to be the same solution, found with different points.
bool CliqueSearch::differ(const Pose& a, const Pose& b) const {
  return (a * centre_ - b * centre_).norm() > 0.005 || angular_distance(a.R, b.R) > 0.03;
}

bool CliqueSearch::mirrored(int chosen) const {
  if (chosen > kFewest) return false;
  return std::any_of(mirrored_.begin(),
                     mirrored_.begin() + static_cast<std::ptrdiff_t>(mirrored_count_),
                     [&](const std::vector<int>& larger) {
                       for (std::size_t i = 0; i < assigned_.size(); ++i) {
                         if (assigned_[i] >= 0 && assigned_[i] != larger[i]) return false;
                       }
                       return true;
                     });
}

}  // namespace mocap
}  // namespace anthrob
