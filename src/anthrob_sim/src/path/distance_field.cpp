#include "path/distance_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace anthrob {

/// The continuous Dijkstra method (Mitchell, Mount, Papadimitriou 1987), as simple as convexity
/// makes it.
class DistanceFieldBuilder {
 public:
  DistanceFieldBuilder(const ConvexHull& hull, const Vec3& from)
      : hull_(hull), from_(from), edges_(hull.half_edge_count()), least_(1e-13 * hull.size()) {}

  void spread(int facet);
  void write(DistanceField& field) const;

 private:
  /// Of an edge, in the frame of the half-edge with the smaller number.
  struct Stretch {
    double begin, end, x, y;
    double squared(double at) const { return (at - x) * (at - x) + y * y; }
  };
  struct Front {
    double nearest;
    Beam beam;
    bool operator<(const Front& other) const { return nearest > other.nearest; }
  };

  Stretch unfolded_through_air(int h) const;
  void light_directly(int facet);
  void arrive(const Beam& beam);
  bool claim(std::vector<Stretch>& held, const Stretch& with, double& lo, double& hi);
  static double crossing(const Stretch& a, const Stretch& b);
  std::vector<DistanceField::Piece> pieces_of(int h) const;

  const ConvexHull& hull_;
  const Vec3 from_;
  std::vector<std::vector<Stretch>> edges_;
  std::vector<Stretch> merged_;
  std::priority_queue<Front> fronts_;
  const double least_;  ///< narrower stretches are left to their neighbours [m]
};

DistanceFieldBuilder::Stretch DistanceFieldBuilder::unfolded_through_air(int h) const {
  const Vec3 side = (hull_.to(h) - hull_.from(h)) * hull_.edge(h).inverse_length;
  const Vec3 arm = from_ - hull_.from(h);
  return {0.0, hull_.edge(h).length, side.dot(arm), side.cross(arm).norm()};
}

/// The facets that the point lies above, and what enters the others over their rim.
void DistanceFieldBuilder::light_directly(int facet) {
  std::vector<char> lit(hull_.facet_count(), 0);
  std::vector<int> queue(1, facet);
  lit[facet] = 1;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (int h = 3 * queue[i]; h < 3 * queue[i] + 3; ++h) {
      const int twin = hull_.edge(h).twin, beyond = ConvexHull::facet_of(twin);
      const int edge = std::min(h, twin);
      edges_[edge].assign(1, unfolded_through_air(edge));
      if (lit[beyond]) continue;
      if (hull_.height(beyond, from_) > 0.0) {
        lit[beyond] = 1;
        queue.push_back(beyond);
      } else {
        const Stretch direct = unfolded_through_air(twin);
        fronts_.push({0.0, {twin, 0.0, direct.end, direct.x, -direct.y, false}});
      }
    }
  }
}

void DistanceFieldBuilder::spread(int facet) {
  light_directly(facet);
  while (!fronts_.empty()) {
    const Beam beam = fronts_.top().beam;
    fronts_.pop();
    Beam next;
    if (beam.left_of_apex(hull_, next)) arrive(next);
    if (beam.right_of_apex(hull_, next)) arrive(next);
  }
}

void DistanceFieldBuilder::arrive(const Beam& beam) {
  const int twin = hull_.edge(beam.edge).twin;
  const double length = hull_.edge(beam.edge).length;
  const bool same = beam.edge < twin;
  const Stretch with = same ? Stretch{beam.a, beam.b, beam.sx, -beam.sy}
                            : Stretch{length - beam.b, length - beam.a, length - beam.sx, -beam.sy};
  double lo, hi;
  if (!claim(edges_[std::min(beam.edge, twin)], with, lo, hi)) return;
  Beam kept = beam;
  kept.a = same ? lo : length - hi;
  kept.b = same ? hi : length - lo;
  const double off = std::max({0.0, kept.a - kept.sx, kept.sx - kept.b});
  fronts_.push({std::hypot(off, kept.sy), kept});
}

/// Where two unfolded points are equally far: squared distances differ by a linear function.
double DistanceFieldBuilder::crossing(const Stretch& a, const Stretch& b) {
  return 0.5 * (a.x * a.x + a.y * a.y - b.x * b.x - b.y * b.y) / (a.x - b.x);
}

/// Assigns to `with` the parts of its interval that are free or reached by a longer way.
/// @param lo, hi span of what it got
bool DistanceFieldBuilder::claim(std::vector<Stretch>& held, const Stretch& with, double& lo,
                                 double& hi) {
  merged_.clear();
  lo = std::numeric_limits<double>::infinity();
  hi = -lo;
  const auto keep = [&](const Stretch& old, double begin, double end) {
    if (end - begin > least_) merged_.push_back({begin, end, old.x, old.y});
  };
  const auto win = [&](double begin, double end) {
    if (end - begin <= least_) return;
    merged_.push_back({begin, end, with.x, with.y});
    lo = std::min(lo, begin);
    hi = std::max(hi, end);
  };
  double reached = with.begin;  // up to here `with` has been compared
  for (const Stretch& old : held) {
    const double begin = std::max(old.begin, with.begin), end = std::min(old.end, with.end);
    if (old.begin > reached) {
      win(reached, std::min(old.begin, with.end));
      reached = std::max(reached, std::min(old.begin, with.end));
    }
    if (end - begin <= least_) {
      merged_.push_back(old);
      reached = std::clamp(old.end, reached, std::max(reached, with.end));
      continue;
    }
    keep(old, old.begin, begin);
    const bool wins_first = with.squared(begin) < old.squared(begin);
    const bool wins_last = with.squared(end) < old.squared(end);
    if (wins_first == wins_last) {
      wins_first ? win(begin, end) : keep(old, begin, end);
    } else {
      const double at = std::clamp(crossing(with, old), begin, end);
      wins_first ? win(begin, at) : keep(old, begin, at);
      wins_last ? win(at, end) : keep(old, at, end);
    }
    keep(old, end, old.end);
    reached = end;
  }
  if (reached < with.end) win(reached, with.end);
  if (!(hi > lo)) return false;
  held.swap(merged_);
  return true;
}

/// In order and without gaps. Where a stretch were missing, the way through the air takes its
/// place: never too long.
std::vector<DistanceField::Piece> DistanceFieldBuilder::pieces_of(int h) const {
  const int twin = hull_.edge(h).twin;
  const double length = hull_.edge(h).length;
  std::vector<Stretch> stretches = edges_[std::min(h, twin)];
  if (h > twin) {
    std::reverse(stretches.begin(), stretches.end());
    for (Stretch& s : stretches) s = {length - s.end, length - s.begin, length - s.x, s.y};
  }
  const Stretch air = unfolded_through_air(h);
  std::vector<DistanceField::Piece> pieces;
  double reached = 0.0;
  const auto bridge = [&](double to) {
    if (to - reached > 1e4 * least_) pieces.push_back({to, air.x, air.y});
  };
  for (const Stretch& s : stretches) {
    bridge(s.begin);
    reached = s.end;
    const bool same = !pieces.empty() && pieces.back().x == s.x && pieces.back().y == s.y;
    same ? void(pieces.back().end = s.end) : pieces.push_back({s.end, s.x, s.y});
  }
  bridge(length);
  if (pieces.empty()) pieces.push_back({length, air.x, air.y});
  pieces.back().end = length;
  return pieces;
}

void DistanceFieldBuilder::write(DistanceField& field) const {
  for (int h = 0; h < hull_.half_edge_count(); ++h) {
    field.first_.push_back(static_cast<int>(field.pieces_.size()));
    const auto pieces = pieces_of(h);
    field.pieces_.insert(field.pieces_.end(), pieces.begin(), pieces.end());
  }
  field.first_.push_back(static_cast<int>(field.pieces_.size()));
}

DistanceField::DistanceField(const ConvexHull& hull, const Vec3& from, int facet) : from_(from) {
  DistanceFieldBuilder builder(hull, from);
  builder.spread(facet);
  builder.write(*this);
}

double DistanceField::beyond(const Beam& beam) const {
  const Piece* piece = &pieces_[first_[beam.edge]];
  const Piece* const last = &pieces_[first_[beam.edge + 1] - 1];
  while (piece != last && piece->end < beam.a) ++piece;
  double lo = beam.a, least = std::numeric_limits<double>::infinity();
  for (;; ++piece) {
    const double hi = piece == last ? beam.b : std::min(beam.b, piece->end);
    least = std::min(least, beam.length_to(piece->x, piece->y, lo, hi));
    if (hi >= beam.b) return least;
    lo = hi;
  }
}

}  // namespace anthrob
