#pragma once

#include "anthrob_core/pose.h"

namespace anthrob {

/// A spring with damper from the grabbed point to the mouse, whose force has a limit:
///   f = k (p_mouse - p_grabbed) - c v_grabbed, shortened to the limit   [N]
///
/// The numbers of a whole arm are for the lightest thing that is pulled: Anthrob's forearm weighs
/// 28 g at the wrist (its inertia about the elbow divided by the square of its length). The force
/// follows the arm some milliseconds late, as states are published and wrenches applied from the
/// next step on. With 100 N/m and 2 Ns/m the loop of this mass has a phase margin of 59 degrees,
/// which 12 ms use up; 300 N/m without damper have none.
struct PullSpring {
  double stiffness = 100.0;  ///< k [N/m], > 0
  double damping = 2.0;      ///< c [Ns/m], >= 0
  double limit = 30.0;       ///< [N], > 0
};

struct Pull {
  Vec3 force_W = Vec3::Zero();  ///< on the grabbed point [N]
  bool limited = false;
};

/// @param grabbed_W, mouse_W [m]   @param velocity_W of the grabbed point [m/s]
Pull pull_of(const PullSpring& spring, const Vec3& grabbed_W, const Vec3& velocity_W,
             const Vec3& mouse_W);

}  // namespace anthrob
