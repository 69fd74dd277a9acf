#pragma once

#include <cstdint>
#include <vector>

#include "core/rigid_fit.h"
#include "labelling/edges.h"
#include "labelling/targets.h"

namespace anthrob {
namespace mocap {

struct LabellingOptions {
  double edge_tolerance = 0.003;     ///< epsilon of (A.3.4) [m]
  double rms_tolerance = 0.0015;     ///< of a fit of four or more markers [m]
  double triple_tolerance = 0.0005;  ///< of a fit of three markers, which can occur by chance [m]
  double tie_margin = 0.00015;  ///< fits up to 2 * best + tie_margin are rivals of the best [m]
  int step_limit = 20000;       ///< of one search; limits the time in cluttered images
};

/// Which points are the markers of a target.
struct Labelling {
  std::vector<int> point;  ///< by marker; -1: not seen
  int count = 0;           ///< markers seen; 0: the target is not found
  RigidFit fit;            ///< target frame to rectified left frame
  bool ambiguous = false;  ///< another labelling fits as well, with another pose
  bool gave_up = false;    ///< stopped at step_limit: may have missed markers or a rival

  /// Whether the other labelling has as many markers and fits about as well: either can be true.
  bool ties_with(const Labelling& other, const LabellingOptions& options) const {
    return count > 0 && other.count == count && other.fit.rms < 2.0 * fit.rms + options.tie_margin;
  }
};

/// Finds the largest part of one target's reference graph in the candidate graph: a maximum clique
/// of the graph whose nodes are (marker, point) and whose edges join nodes of equal distance within
/// the tolerance. Depth first over the markers, on bit sets, with the best size so far as bound.
/// Distances do not distinguish a target from its mirror image: the rigid fit does, because its
/// residual is then large.
class CliqueSearch {
 public:
  CliqueSearch(const MarkerTarget& target, const LabellingOptions& options);

  /// @param edges of find_edges
  /// @param usable by point; false: belongs to another target
  /// @return the labelling of most markers and then of least residual; ambiguous if a rival of as
  ///   many markers fits about as well elsewhere
  const Labelling& find(const std::vector<MarkerPoint>& points, const std::vector<Edge>& edges,
                        const std::vector<char>& usable);

  double longest_edge() const { return longest_; }

 private:
  struct ReferenceEdge {
    int i, j;
    double length;
  };
  using Word = std::uint64_t;

  void build(const std::vector<MarkerPoint>& points, const std::vector<Edge>& edges,
             const std::vector<char>& usable);
  Word* links(int marker, int point, int other_marker);
  Word* allowed(int level, int marker);
  bool any(const Word* set) const;
  void descend(int level, int chosen);
  void judge(int chosen);
  bool mirrored(int chosen) const;
  bool differ(const Pose& a, const Pose& b) const;

  MarkerTarget target_;
  Vec3 centre_;
  LabellingOptions options_;
  std::vector<ReferenceEdge> reference_;
  double longest_ = 0.0;

  // Scratch, kept between calls.
  const std::vector<MarkerPoint>* points_ = nullptr;
  int point_count_ = 0, words_ = 0, steps_ = 0;
  std::vector<Word> links_, allowed_;
  std::vector<int> assigned_;
  Labelling best_, rival_;
  std::vector<std::vector<int>> mirrored_;
  std::size_t mirrored_count_ = 0;
};

}  // namespace mocap
}  // namespace anthrob
