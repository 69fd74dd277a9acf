#pragma once

#include <string>
#include <vector>

#include "anthrob_sim/simulation.h"

namespace anthrob {

/// A wrapping surface on a solved path. Tensions between origin and spring are the current ones;
/// those between spring and insertion acted during the last step.
struct SolvedContact {
  int entry = -1;       ///< of the path in the file, origin 0; -1: added by an effect
  std::string surface;  ///< type
  std::string body;
  bool touching = false;
  Vec3 entry_W = Vec3::Zero();  ///< [m]; off the surface, entry and exit coincide
  Vec3 exit_W = Vec3::Zero();   ///< [m]
  double wrap_angle = 0.0;      ///< [rad]
  double length = 0.0;          ///< along the surface [m]
  double tension_in = 0.0;      ///< on the origin's side [N]
  double tension_out = 0.0;     ///< on the insertion's side [N]
  double penetration = 0.0;     ///< depth of the deeper neighbouring path point inside, >= 0 [m]
};

struct SolvedPath {
  std::string muscle;
  double length = 0.0;            ///< l_M [m]
  double velocity = 0.0;          ///< dl_M/dt [m/s]
  double spring_expansion = 0.0;  ///< [m]
  bool slack = false;             ///< no tension in the spring
  std::vector<SolvedContact> contacts;
};

/// Path of a muscle in the current state of the simulation.
SolvedPath solved_path(const Simulation& sim, int muscle);

/// A path point inside a neighbouring wrapping surface, where a real tendon could not be.
struct Penetration {
  std::string muscle;
  int entry = -1;       ///< of the surface in the path of the file; -1: added by an effect
  std::string surface;  ///< type
  std::string body;     ///< that carries the surface
  double depth = 0.0;   ///< [m]; 0: nothing lies inside anything

  /// "posterior_deltoid: a path point lies 3.2 mm inside the cylinder on humerus (path.4)"
  std::string text() const;
};

/// The deepest penetration in the simulation's current posture.
Penetration deepest_penetration(const Simulation& sim);
Penetration deepest_penetration(const Muscle& muscle, const SkeletonModel& skeleton);

}  // namespace anthrob
