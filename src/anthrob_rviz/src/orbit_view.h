#pragma once

#include "anthrob_core/pose.h"

namespace anthrob {

/// An axis-aligned box [m].
struct Box {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
};

/// Where a camera that orbits about a point, with z upwards, looks, and from how far.
struct OrbitView {
  Vec3 focus = Vec3::Zero();  ///< [m]
  double distance = 0.0;      ///< [m]
};

/// The nearest view of the middle of a box that shows all of it, with a tenth to spare.
/// @param yaw, pitch of the camera, seen from the focus [rad]   @param opening of the picture's
/// height [rad]   @param aspect width of the picture over its height
OrbitView fitting_view(const Box& box, double yaw, double pitch, double opening, double aspect);

}  // namespace anthrob
