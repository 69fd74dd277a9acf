#pragma once

#include <deque>

#include "touch/skeleton.h"

namespace anthrob {

/// Postures of the last second of the robot's time. A window tells where the mouse is by a link's
/// frame as it was when the window drew it.
class PostureHistory {
 public:
  static constexpr double kLength = 1.0;  ///< [s]
  static constexpr double kSlope = 0.01;  ///< [s] over which velocities are measured

  /// One of the same time replaces the one before; where time goes back, the history begins anew.
  void add(double time, const Posture& posture);
  bool empty() const { return entries_.empty(); }
  double newest_time() const { return entries_.back().time; }
  /// To be asked only if not empty, as what follows.
  const Posture& newest() const { return entries_.back().posture; }
  /// The last one until `time`; the oldest if all are later.
  const Posture& at(double time) const;
  /// Mean velocity of a point of a link in the root over the last kSlope [m/s].
  Vec3 velocity(const Skeleton& skeleton, std::size_t link, const Vec3& point_L) const;

 private:
  struct Entry {
    double time;
    Posture posture;
  };
  const Entry& entry_at(double time) const;

  std::deque<Entry> entries_;
};

}  // namespace anthrob
