#pragma once

#include <memory>
#include <string>
#include <vector>

#include "anthrob_core/config_node.h"
#include "anthrob_core/pose.h"
#include "anthrob_sim/core/state.h"

namespace anthrob {

/// Penetration up to this depth counts as zero: table values are rounded to 0.1 mm [m].
constexpr double kRoundingDepth = 0.0002;

/// How a muscle runs over one surface, in the frame in which it was asked for.
/// Off the surface, entry and exit coincide on the straight line. Where pulls are not along the
/// tendon (it leans on the border of a mesh's side), they are the end points.
struct WrapContact {
  bool touching = false;
  Vec3 entry = Vec3::Zero();  ///< where the tendon, seen from the origin, meets the surface [m]
  Vec3 exit = Vec3::Zero();   ///< where it leaves [m]
  Vec3 direction_in = Vec3::Zero();   ///< unit, from the preceding point to `entry`
  Vec3 direction_out = Vec3::Zero();  ///< unit, from `exit` to the succeeding point
  double length_in = 0.0;             ///< preceding point to entry [m]
  double length_on = 0.0;             ///< along the surface [m]
  double length_out = 0.0;            ///< exit to succeeding point [m]
  double turning = 0.0;               ///< angle by which the surface turns the tendon [rad]
  double wrap_angle = 0.0;            ///< angle about the surface's axis or centre [rad]
  int half_turns = 0;  ///< multiples of pi in wrap_angle: the revolution counter of (4.26)
  /// Depth of the deeper end point inside the surface, touching or not, >= 0 [m]. For the path,
  /// such a point is moved to the surface of a mesh, or towards the surface of a sphere or
  /// cylinder.
  double penetration = 0.0;
  /// Force on the preceding point, and on the surface from the succeeding one, per unit of tension:
  /// the directions, except where a point lies inside. There they are the gradient of the length,
  /// so that the tendon still does no work of its own.
  Vec3 pull_in = Vec3::Zero();
  Vec3 pull_out = Vec3::Zero();
};

/// A surface in the muscle path, between two path points. Frictionless geometry: the shortest path
/// that stays on the side on which the tendon came to lie. Stateless but for `state`, which
/// remembers that side.
class WrappingSurface {
 public:
  virtual ~WrappingSurface() = default;

  virtual std::string type() const = 0;
  virtual std::size_t state_size() const = 0;

  /// Initialises `state` from a first posture and the side given in the model file.
  /// All points are in the frame of the surface's body.
  virtual void initialise(const Vec3& before, const Vec3& after, StateView state) const = 0;

  /// Follows the posture. `contact` is complete afterwards.
  virtual void wrap(const Vec3& before, const Vec3& after, StateView state,
                    WrapContact& contact) const = 0;

  /// Appends points of the path on the surface, from entry to exit, for drawing.
  virtual void trace(const WrapContact& contact, std::vector<Vec3>& points) const = 0;

  /// The same surface, prepared for neighbours that never move in its frame; null where that saves
  /// nothing. Its results are the same, even if the neighbours move.
  /// @param before, after the point next to it, or null if it moves
  virtual std::shared_ptr<const WrappingSurface> prepared_for(const Vec3* /*before*/,
                                                              const Vec3* /*after*/) const {
    return nullptr;
  }

  /// Remarks for the user on the files that the surface was read from, one line each.
  virtual std::vector<std::string> remarks() const { return {}; }
};

/// Fills `contact` for a tendon that runs straight from `before` to `after`, meeting at `point`'s
/// projection on that line.
void set_straight(const Vec3& before, const Vec3& after, const Vec3& point, WrapContact& contact);

}  // namespace anthrob
