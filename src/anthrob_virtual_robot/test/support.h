#pragma once

#include <string>

#include "hidden_law.h"
#include "robot.h"

namespace anthrob::virtual_robot {

inline const reference::ArmParameters& model_I() {
  static const auto arm =
      reference::Arm::load(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml");
  return arm;
}

/// The law that a hidden thing puts into a muscle.
inline std::shared_ptr<reference::MuscleLaw> muscle_law(const Hidden& hidden) {
  Draft draft;
  draft.arm = model_I();
  build_in(hidden, &draft);
  return draft.muscle_laws.at(0).second;
}

/// What a law is told: a strain, a tension all along, a sliding speed.
inline reference::MuscleSolution solution_of(double strain, double tension, double sliding = 0.0) {
  reference::MuscleSolution solution;
  solution.strain = strain;
  solution.tensions.assign(3, tension);
  solution.sliding.assign(2, sliding);
  return solution;
}

/// Some seconds of motion of all muscles.
inline Readings moved(Robot* robot, double seconds) {
  robot->place(std::vector<double>(robot->muscle_count(), 0.6));
  const auto ticks = static_cast<int>(seconds / robot->period());
  for (int k = 0; k < ticks; ++k) {
    std::vector<double> references;
    for (std::size_t i = 0; i < robot->muscle_count(); ++i) {
      references.push_back(0.8 +
                           0.3 * std::sin(12.0 * k * robot->period() + static_cast<double>(i)));
    }
    robot->command(references);
    robot->tick();
  }
  return robot->measured();
}

inline bool same(const Readings& a, const Readings& b) {
  bool same = a.elbow == b.elbow && a.shoulder.coeffs() == b.shoulder.coeffs();
  for (std::size_t i = 0; i < a.muscles.size(); ++i) {
    const MuscleReading &p = a.muscles[i], &q = b.muscles[i];
    same = same && p.position == q.position && p.velocity == q.velocity && p.current == q.current &&
           p.force == q.force;
  }
  return same;
}

}  // namespace anthrob::virtual_robot
