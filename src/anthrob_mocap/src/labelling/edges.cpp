#include "labelling/edges.h"

#include <algorithm>
#include <tuple>

namespace anthrob {
namespace mocap {

void find_edges(const std::vector<MarkerPoint>& points, double longest, std::vector<Edge>& edges) {
  edges.clear();
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = a + 1; b < points.size(); ++b) {
      if (points[a].blob[kLeft] == points[b].blob[kLeft] ||
          points[a].blob[kRight] == points[b].blob[kRight]) {
        continue;
      }
      const double length = (points[a].p - points[b].p).norm();
      if (length <= longest) edges.push_back({static_cast<int>(a), static_cast<int>(b), length});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
    return std::tie(x.length, x.a, x.b) < std::tie(y.length, y.a, y.b);
  });
}

}  // namespace mocap
}  // namespace anthrob
