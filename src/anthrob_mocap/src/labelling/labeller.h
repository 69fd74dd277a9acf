#pragma once

#include <vector>

#include "labelling/clique_search.h"
#include "labelling/motion_prior.h"

namespace anthrob {
namespace mocap {

/// Finds all targets among the points. No blob is used twice; if two targets claim the same blobs
/// and fit them equally well, neither is found. Frames must come in the order of time.
class Labeller {
 public:
  Labeller(const std::vector<MarkerTarget>& targets, const LabellingOptions& options,
           const MotionOptions& motion);

  /// @param t [s] exposure
  /// @param cut some points of the picture were left out: three markers make no pose then, nor in a
  ///   crowd of points
  /// @param result replaced: one for every target, of count 0 if it is not found
  void label(double t, const std::vector<MarkerPoint>& points, bool cut,
             const std::vector<Edge>& edges, std::vector<Labelling>& result);

  double longest_edge() const { return longest_; }  ///< [m] the longest that any target needs

 private:
  void withdraw_used(const Labelling& labelling, const std::vector<MarkerPoint>& points);
  bool collides(const Labelling& labelling) const;
  bool contested(const Labelling& labelling, const std::vector<MarkerPoint>& points,
                 std::vector<Labelling>& result);
  static bool share_blobs(const Labelling& a, const Labelling& b,
                          const std::vector<MarkerPoint>& points);

  LabellingOptions options_;
  std::vector<CliqueSearch> searches_;
  std::vector<MotionPrior> priors_;
  double longest_ = 0.0;
  std::vector<char> usable_;
  std::vector<std::size_t> open_;  ///< targets that are not decided yet
};

}  // namespace mocap
}  // namespace anthrob
