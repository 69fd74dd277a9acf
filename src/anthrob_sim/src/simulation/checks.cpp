#include "simulation/checks.h"

#include "anthrob_core/errors.h"
#include "anthrob_sim/actuator/actuator.h"

namespace anthrob {

void expect_finite(double value, const char* kind, const std::string& name, const char* what) {
  if (std::isfinite(value)) return;
  throw BadInput(std::string(kind) + name + what + ": expected a finite number");
}

void expect_sensible(double value, const char* kind, const std::string& name, const char* what) {
  if (is_sensible(value)) return;
  throw BadInput(std::string(kind) + name + what + ": expected a finite number below 1e9");
}

void expect_reachable(double position, const char* kind, const MuscleModel& muscle,
                      const char* what) {
  constexpr double kGive = 0.05;
  const double highest = muscle.actuator->highest_position();
  if (position <= highest + kGive) return;
  throw BadInput(kind + muscle.name + what + ": " + std::to_string(position) +
                 ": expected at most " + std::to_string(highest));
}

void expect_posture(const std::vector<double>& q, const SkeletonModel& skeleton) {
  if (q.size() != static_cast<std::size_t>(skeleton.position_count)) {
    throw BadInput("posture: expected " + std::to_string(skeleton.position_count) +
                   " joint numbers");
  }
  for (const JointModel& joint : skeleton.joints) {
    const double* p = &q[joint.position_offset];
    double squares = 0.0;
    for (int k = 0; k < joint.position_size(); ++k) {
      expect_sensible(p[k], "posture: joint ", joint.name, "");
      squares += p[k] * p[k];
    }
    if (joint.type == JointType::kBall && squares < 1e-12) {
      throw BadInput("posture: joint " + joint.name + ": expected a quaternion that is not zero");
    }
  }
}

void expect_index(int index, std::size_t count, const char* kind) {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return;
  throw BadInput(std::string(kind) + " " + std::to_string(index) + ": expected an index below " +
                 std::to_string(count));
}

}  // namespace anthrob
