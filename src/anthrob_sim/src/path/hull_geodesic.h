#pragma once

#include <vector>

#include "path/horizon.h"
#include "path/strip_search.h"

namespace anthrob {

/// Shortest way round a convex hull between two points whose connecting segment cuts the hull.
///
/// The guess, such as the shortest strip of facets in the last posture, is fitted to the new points
/// and pulled taut; StripSearch then looks for anything shorter. The result does not depend on the
/// guess; the computing time does. Scratch memory: one object per thread serves any number of
/// hulls.
class HullGeodesic {
 public:
  enum class Outcome {
    kConfirmed,  ///< the guess was the shortest
    kImproved,   ///< the search found a shorter one
    kCold        ///< there was no guess, or it did not fit any more
  };

  /// Memory for a hull of this size; later calls do not allocate.
  void reserve(const ConvexHull& hull);

  /// @param facet one that the source lies above
  /// @param strip guess or empty on entry; the shortest on return
  Outcome solve(const GeodesicQuery& query, int facet, std::vector<int>& strip);

  /// Of the last solution [m].
  double length() const { return length_; }
  const std::vector<TautString::Crossing>& crossings() const { return string_.crossings(); }

 private:
  bool fit(const GeodesicQuery& query, std::vector<int>& strip);
  bool cut(const GeodesicQuery& query, std::vector<int>& strip);
  bool walk(const GeodesicQuery& query, const Vec3& through, bool to_source, int from);

  TautString string_;
  StripSearch search_;
  Horizon rim_;  ///< of the source
  std::vector<int> walked_;
  double length_ = 0.0;
};

}  // namespace anthrob
