#pragma once

#include <Eigen/Core>

namespace anthrob::reference {

/// How a tendon lies on a cylinder; changes only between time steps.
struct WrapMemory {
  int side = 0;        ///< 0 free; +1 / -1 turns positively / negatively about the axis
  double angle = 0.0;  ///< arc [rad], unwrapped, 0 when free
};

/// Infinite cylinder as one tendon span sees it, in any frame that the end points are in.
struct PlacedCylinder {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit
  double radius = 0.0;                              ///< [m]
};

/// Tendon between two points: straight, or helix between two tangent lines.
struct SpanGeometry {
  double length = 0.0;
  double angle = 0.0;  ///< arc [rad]
  /// From start to end, each at its point: d length = u_end d end - u_start d start.
  Eigen::Vector3d u_start = Eigen::Vector3d::Zero();
  Eigen::Vector3d u_end = Eigen::Vector3d::Zero();
};

/// Contact after a motion from the posture that `memory` belongs to. A free tendon touches when its
/// straight segment cuts the cylinder, on the side where the segment runs (the short way round); a
/// touching one keeps its side until the unwrapped arc returns to zero.
WrapMemory next_contact(const PlacedCylinder& cylinder, const Eigen::Vector3d& start,
                        const Eigen::Vector3d& end, const WrapMemory& memory);

/// Shortest path on the remembered side: the closed form of (4.29)-(4.33), for unrolled plane path
/// P and axial distance z, is length = sqrt(P^2 + z^2). A point inside is lifted to the surface.
SpanGeometry wrapped_span(const PlacedCylinder& cylinder, const Eigen::Vector3d& start,
                          const Eigen::Vector3d& end, const WrapMemory& memory);

/// Straight tendon.
SpanGeometry straight_span(const Eigen::Vector3d& start, const Eigen::Vector3d& end);

/// How far the deeper of the two points is inside [m], 0 if both are outside.
double penetration(const PlacedCylinder& cylinder, const Eigen::Vector3d& start,
                   const Eigen::Vector3d& end);

}  // namespace anthrob::reference
