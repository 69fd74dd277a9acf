#pragma once

#include <functional>
#include <string>
#include <vector>

#include "anthrob_sim/simulation.h"

namespace anthrob {

/// A scalar of a simulation, by a path such as "elbow/friction_torque", in SI units.
struct Quantity {
  std::string path;
  std::function<double(const Simulation& sim)> read;
  bool of_reactions = false;  ///< needs Simulation::observe_reactions()
};

/// Everything about a robot that is a number:
///   energy/..., power/...         of the whole robot
///   JOINT/position, velocity, friction_torque or friction_force, effort, load, reaction/x, ...
///   MUSCLE/length, tension/0, ... (by segment from the origin), spring/..., actuator/..., ...
/// Components of ball joints are w, x, y, z of the rotation from rest, otherwise x, y, z in the
/// child's axes; those of reactions in the parent's.
std::vector<Quantity> quantities_of(const RobotModel& model);

/// Those with the given paths, in that order.
/// @throws BadInput naming the path that is not known, with the nearest one
std::vector<Quantity> select_quantities(const std::vector<Quantity>& all,
                                        const std::vector<std::string>& paths);

}  // namespace anthrob
