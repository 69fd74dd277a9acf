#pragma once

#include "core/types.h"

namespace anthrob {
namespace mocap {

struct MotionOptions {
  double max_turn_rate = 6.0;  ///< [rad/s]
  double max_speed = 1.5;      ///< [m/s]
  double memory = 0.25;        ///< [s] for how long a pose constrains the next ones
};

/// Compares a pose with the recent motion of its target. It never creates or changes a pose; it
/// only rejects implausible poses of three markers, one of which may be a reflection. Poses of more
/// markers are always accepted. If they jump (single pictures, a bag that loops), there is no
/// motion to compare with, and nothing is rejected.
class MotionPrior {
 public:
  /// @param centre of the target, in its frame [m]
  MotionPrior(const MotionOptions& options, const Vec3& centre)
      : options_(options), centre_(centre) {}

  bool contradicts(double t, const Pose& X) const {
    return streak_ >= kSteady && recent(t) && !near(t, X);
  }
  void accept(double t, const Pose& X);

 private:
  static constexpr int kSteady = 5;

  bool recent(double t) const { return known_ && t > t_ && t - t_ <= options_.memory; }
  bool near(double t, const Pose& X) const;

  MotionOptions options_;
  Vec3 centre_;
  bool known_ = false;  ///< there is a last pose
  int streak_ = 0;      ///< poses in a row that agree with the motion
  double t_ = 0.0;
  Pose X_;
};

}  // namespace mocap
}  // namespace anthrob
