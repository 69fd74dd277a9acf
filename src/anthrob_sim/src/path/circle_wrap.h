#pragma once

#include "anthrob_core/config_node.h"
#include "anthrob_sim/core/state.h"
#include "anthrob_sim/path/wrapping_surface.h"

namespace anthrob {

/// Side on which a tendon lies before the first posture is looked at: chi of (4.23) and (4.28).
enum class WrapStart { kNotWrapping, kPositive, kNegative };

/// The state machine of a tendon round a circle (Figure 4.8), shared by sphere and cylinder.
///
/// The thesis tracks three states, flips of the normal j_1 x j_2 and a revolution counter. All of
/// that is one continuous number: the angle `theta` from the preceding to the succeeding point
/// about a fixed normal, unwrapped over time. The tendon turns by alpha = |theta| - acos(r/l_1) -
/// acos(r/l_2) and lifts off when alpha returns to zero; it touches down when the straight segment
/// between the points would cut the circle, on the short side.
class CircleWrap {
 public:
  struct State {
    double theta;  ///< [rad] unwrapped while touching; in (-pi, pi] otherwise
    double side;   ///< +1, -1: sense of rotation about the normal while touching; 0: off the circle
  };

  /// Effective position of a point: its own if it is outside the circle; if inside, lifted along
  /// the ray from the centre.
  struct Lift {
    double distance;  ///< from the centre [m]
    double around;    ///< gain of motions round the centre, in [1, 2]; 1 outside
    double outward;   ///< gain of motions along the ray, in [0, 2]; 1 outside
  };

  struct Result {
    bool touching = false;
    Lift lift1, lift2;         ///< of the preceding and the succeeding point
    double penetration = 0.0;  ///< depth of the deeper point, whether touching or not [m]
    double radius = 0.0;       ///< of the circle that the tendon follows, see lift() [m]
    bool follows1 = false, follows2 = false;  ///< whether that circle runs through a lifted point
    double side = 0.0;
    double alpha = 0.0;             ///< wrapping angle, >= 0 [rad]
    double b1 = 0.0, b2 = 0.0;      ///< lengths of the straight parts in the plane [m]
    double cos1 = 1.0, sin1 = 0.0;  ///< of the angle from the preceding point to its tangent point
    double cos2 = 1.0, sin2 = 0.0;  ///< of the angle from the succeeding point to its tangent point
  };

  /// @param radius [m], > 0
  /// @param half_turns initial revolution counter Lambda of (4.26), >= 0: a tendon that touches at
  /// the start is wound on by whole turns until it has at least so many
  CircleWrap(double radius, WrapStart start, int half_turns);

  double radius() const { return radius_; }

  /// Effective position of a point. A point inside, at share s of the radius, is treated as lying
  /// at share s (2 - s): nearly on the circle if it is a little inside, at the centre if it is
  /// there. The tendon then follows the circle through the lifted point that is nearer to the
  /// centre. So the length is unique and has a bounded gradient everywhere. It has a kink only
  /// where a point crosses the circle while the tendon does not touch, where both points are
  /// equally deep inside, and where a tendon with a point inside would be wound on by a turn: it
  /// goes the other way round instead. Near the centre turns cost no length, and a tendon that had
  /// many would be pulled to the centre by forces without bounds.
  /// @param distance from the centre [m]
  Lift lift(double distance) const;

  /// @param angle from the preceding to the succeeding point about the normal, in (-pi, pi]
  /// @param l1,l2 their distances from the centre [m]
  void initialise(double angle, double l1, double l2, State& state) const;
  Result update(double angle, double l1, double l2, State& state) const;

  /// Whether the straight segment between two points stays clear of the circle: the cheap common
  /// case.
  /// @param x1,y1,x2,y2 points in the plane, centre at zero
  bool segment_is_clear(double x1, double y1, double x2, double y2) const;

 private:
  double radius_;
  WrapStart start_;
  int half_turns_;
};

/// Completes the contact of a tendon that has a point inside: the pulls are the gradient of the
/// length with respect to the original points, and act there. Directions and turning are those of
/// the lifted points.
/// @param ray1,ray2 unit, from axis or centre to the points   @param axis unit; zero for a sphere
void pull_inside(const CircleWrap::Result& wrap, const Vec3& ray1, const Vec3& ray2,
                 const Vec3& axis, const Vec3& before, const Vec3& after, WrapContact& contact);

/// Reads `radius`, `start` and `half_turns` of a sphere or cylinder.
CircleWrap read_circle_wrap(const ConfigNode& node);

}  // namespace anthrob
