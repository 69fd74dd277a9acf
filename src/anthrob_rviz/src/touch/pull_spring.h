#pragma once

#include "anthrob_core/pose.h"

namespace anthrob {

/// A spring with damper from the grabbed point to the mouse, whose force has a limit:
///   f = k (p_mouse - p_grabbed) - c v_grabbed, shortened to the limit   [N]
///
/// The numbers are for the lightest thing that is pulled: Anthrob's forearm weighs 28 g at the
/// wrist (its inertia about the elbow divided by the square of its length). The force follows the
/// arm some milliseconds late, as states are published and wrenches applied from the next step on.
/// With 100 N/m and 2 Ns/m the loop of this mass has a phase margin of 59 degrees, which a delay of
/// 12 ms uses up; with 300 N/m and no damper it has none.
struct PullSpring {
  double stiffness = 100.0;  ///< k [N/m], > 0
  double damping = 2.0;      ///< c [Ns/m], >= 0
  double limit = 30.0;       ///< [N], > 0
};

/// A spring with the same margin although forces are renewed this seldom: softer in inverse
/// proportion to the square of the time between two renewals.
/// @param period [s] of the robot's time
PullSpring softened(const PullSpring& spring, double period);

/// The mean time between the last renewals [s].
class RenewalPeriod {
 public:
  void renewed(double time);
  double mean() const { return mean_; }

 private:
  static constexpr double kPause = 0.2;   ///< [s] longer ones lie between two drags
  static constexpr double kWeight = 0.1;  ///< of the last one
  double last_ = 0.0;
  double mean_ = 0.0;
};

struct Pull {
  Vec3 force_W = Vec3::Zero();  ///< on the grabbed point [N]
  bool limited = false;
};

/// @param grabbed_W, mouse_W [m]   @param velocity_W of the grabbed point [m/s]
Pull pull_of(const PullSpring& spring, const Vec3& grabbed_W, const Vec3& velocity_W,
             const Vec3& mouse_W);

}  // namespace anthrob
