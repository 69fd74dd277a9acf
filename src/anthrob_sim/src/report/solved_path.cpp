#include "report/solved_path.h"

#include <cstdio>

namespace anthrob {

namespace {

double lengthening_speed(const MusclePath& path, const KinematicTree& tree) {
  std::vector<double> arms(tree.velocities().size(), 0.0);
  for (std::size_t i = 0; i < path.segments().size(); ++i) {
    path.add_moment_arms(i, 1.0, tree, arms.data());
  }
  double speed = 0.0;
  for (std::size_t k = 0; k < arms.size(); ++k) speed -= arms[k] * tree.velocities()[k];
  return speed;
}

}  // namespace

SolvedPath solved_path(const Simulation& sim, int index) {
  const Muscle& muscle = sim.muscle(index);
  const MusclePath& path = muscle.path();
  SolvedPath solved;
  solved.muscle = muscle.model().name;
  solved.length = muscle.length();
  solved.spring_expansion = muscle.expansion();
  solved.slack = !(muscle.spring_tension() > 0.0);
  solved.velocity = lengthening_speed(path, sim.tree());
  const auto& obstacles = path.model().obstacles();
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    if (!obstacles[i].surface) continue;
    const ObstacleState& state = path.obstacles()[i];
    solved.contacts.push_back({obstacles[i].entry, obstacles[i].surface->type(),
                               sim.model().skeleton->bodies[obstacles[i].body].name, state.touching,
                               path.segments()[i - 1].to_W, path.segments()[i].from_W,
                               state.touching ? state.wrap_angle : 0.0, state.length_on,
                               muscle.tension(i - 1), muscle.tension(i), state.penetration});
  }
  return solved;
}

std::string Penetration::text() const {
  char millimetres[32];
  std::snprintf(millimetres, sizeof(millimetres), "%.1f", 1e3 * depth);
  return muscle + ": a path point lies " + millimetres + " mm inside the " + surface + " on " +
         body + (entry < 0 ? " added by an effect" : " (path." + std::to_string(entry) + ")");
}

Penetration deepest_penetration(const Muscle& muscle, const SkeletonModel& skeleton) {
  const auto& obstacles = muscle.path().model().obstacles();
  Penetration deepest;
  std::size_t at = 0;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const double depth = muscle.path().obstacles()[i].penetration;
    if (depth > deepest.depth) deepest.depth = depth, at = i;
  }
  if (deepest.depth == 0.0) return deepest;
  return {muscle.model().name, obstacles[at].entry, obstacles[at].surface->type(),
          skeleton.bodies[obstacles[at].body].name, deepest.depth};
}

Penetration deepest_penetration(const Simulation& sim) {
  Penetration deepest;
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
    Penetration found = deepest_penetration(sim.muscle(static_cast<int>(m)), *sim.model().skeleton);
    if (found.depth > deepest.depth) deepest = std::move(found);
  }
  return deepest;
}

}  // namespace anthrob
