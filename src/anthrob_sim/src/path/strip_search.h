#pragma once

#include <cstdint>
#include <vector>

#include "path/beam.h"
#include "path/taut_string.h"

namespace anthrob {

/// Exact search for the strip through which the shortest way runs.
///
/// Straight lines from the source, unfolded over the facets, reach each edge in windows: stretches
/// of the edge that see the (unfolded) source through one and the same strip. Windows are carried
/// on from edge to edge; at a corner they split. On a convex body no shortest way passes a corner,
/// so this covers all ways except those along the limit: for them each point in which an edge
/// crosses the limit becomes a source of its own.
///
/// A window is dropped as soon as it cannot lead to a way shorter than the best one known. If the
/// distances from the target are known, they bound the rest of the way: only windows on a shorter
/// way survive. Otherwise the bound is the straight-line distance: with a good first guess few
/// windows survive, as long as the way turns by less than a right angle.
class StripSearch {
 public:
  /// Ways shorter by less than this share of the hull's size are the same.
  static constexpr double kSame = 1e-9;

  void reserve(const ConvexHull& hull);

  /// @param rim half-edges through which the facets hidden from the source are entered
  /// @param bound only shorter ways are looked for [m]
  /// @return length of the shortest such way, or `bound`
  double run(const GeodesicQuery& query, const std::vector<int>& rim, double bound);

  const std::vector<int>& strip() const { return strip_; }  ///< of the way found, else empty

 private:
  struct Window {
    Beam beam;
    int depth;
    double before;  ///< length of the way to the beam's source: 0, or to a point of the limit
    double clear0, clear1;  ///< clearance of the edge's ends
    double far0, far1;      ///< their squared distances to the target
    double least;           ///< no way through the window is shorter
  };

  void enter(const GeodesicQuery& query, int half_edge);
  void consider(const GeodesicQuery& query, Window& window);
  void open_point(const GeodesicQuery& query, const Window& window, double x);
  double through_air(const GeodesicQuery& query, const Window& window) const;
  void carry_on(const GeodesicQuery& query, const Window& window);
  void keep_if_better(const Window& window, double length);

  std::vector<Window> stack_;
  std::vector<int> chain_, strip_;
  std::vector<double> label_;  ///< shortest way known to where an edge crosses the limit
  std::vector<std::uint64_t> label_run_;
  std::uint64_t run_ = 0;
  double best_ = 0.0, worthwhile_ = 0.0;
};

}  // namespace anthrob
