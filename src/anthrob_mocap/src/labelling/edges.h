#pragma once

#include <vector>

#include "triangulation/triangulator.h"

namespace anthrob {
namespace mocap {

/// Two points that can be markers of one target, and their distance [m].
struct Edge {
  int a, b;
  double length;
};

/// All edges up to a length, from short to long: once for a pair of images, for all targets
/// ("Points-2-Edges"). Points that share a blob exclude each other: no edge.
void find_edges(const std::vector<MarkerPoint>& points, double longest, std::vector<Edge>& edges);

}  // namespace mocap
}  // namespace anthrob
