#pragma once

#include <cstddef>

#include "core/types.h"

namespace anthrob {
namespace mocap {

/// Pairs of points to be brought onto each other; at most kMost.
class PointPairs {
 public:
  static constexpr std::size_t kMost = 16;

  void clear() { count_ = 0; }
  void add(const Vec3& from, const Vec3& to) { from_[count_] = from, to_[count_++] = to; }
  std::size_t size() const { return count_; }
  const Vec3& from(std::size_t i) const { return from_[i]; }
  const Vec3& to(std::size_t i) const { return to_[i]; }

 private:
  Vec3 from_[kMost], to_[kMost];
  std::size_t count_ = 0;
};

struct RigidFit {
  Pose X;            ///< to = X from
  double rms = 0.0;  ///< [m] of the distances left
};

/// The rotation (never a reflection) and translation of least squares [Umeyama 1991, without
/// scale]. Needs three pairs that are not on one line.
RigidFit fit_rigid(const PointPairs& pairs);

}  // namespace mocap
}  // namespace anthrob
