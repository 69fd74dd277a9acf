#pragma once

#include <cstdint>
#include <vector>

#include "anthrob_sim/path/taut_string.h"

namespace anthrob {

/// Exact search for the strip through which the shortest way runs.
///
/// Straight lines from the source, unfolded over the facets, reach each edge in windows: stretches
/// of the edge that see the (unfolded) source through one and the same strip. Windows are carried
/// on from edge to edge; at a corner they split. On a convex body no shortest way passes a corner,
/// so this covers all ways but those that lean on the limit: for them each point in which an edge
/// crosses the limit becomes a source of its own.
///
/// A window is dropped as soon as it cannot lead to a way shorter than the best one known, even if
/// the rest ran through the air: with a good first guess few windows live.
class StripSearch {
 public:
  void reserve(const ConvexHull& hull);

  /// @param rim half-edges through which the facets hidden from the source are entered
  /// @param bound only shorter ways are looked for [m]
  /// @return length of the shortest such way, or `bound`
  double run(const GeodesicQuery& query, const std::vector<int>& rim, double bound);

  const std::vector<int>& strip() const { return strip_; }  ///< of the way found, else empty
  int windows() const { return windows_; }                  ///< looked at in the last run

 private:
  /// A stretch [a, b] of an edge, in the frame of the half-edge, and the unfolded source.
  struct Window {
    int edge, depth;
    double a, b;
    double sx, sy;  ///< sy <= 0
    double before;  ///< length of the way to the unfolded source: 0, or to a point of the limit
    double clear0, clear1;  ///< clearance of the edge's ends
    double far0, far1;      ///< their squared distances to the target
    double least;           ///< no way through the window is shorter
    bool point;             ///< the source is the point a = b of the edge
  };

  void consider(const GeodesicQuery& query, Window& window);
  void open_point(const Window& window, double x, double remaining);
  void carry_on(const GeodesicQuery& query, const Window& window);
  void keep_if_better(const Window& window, double length);

  std::vector<Window> stack_;
  std::vector<int> chain_, strip_;
  std::vector<double> label_;  ///< shortest way known to where an edge crosses the limit
  std::vector<std::uint64_t> label_run_;
  std::uint64_t run_ = 0;
  double best_ = 0.0, worthwhile_ = 0.0;
  int windows_ = 0;
};

}  // namespace anthrob
