#include "measurement/counts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "anthrob_core/text.h"
#include "anthrob_recording/resolution.h"

namespace anthrob {
namespace discovery {

namespace {

/// Sensors of one kind.
struct CountedKind {
  std::string kind, unit, quantity;  ///< "joint position", "rad", "position"
  double known = 0.0;                ///< count of the model's sensors [unit]
  std::vector<std::string> places;
};

std::vector<CountedKind> counted_kinds(const RobotModel& robot) {
  const SensorsModel& sensors = robot.sensors;
  CountedKind position{"position", "rad", "position", sensors.position.quantum, {}},
      velocity{"velocity", "rad/s", "velocity", sensors.velocity.quantum, {}},
      current{"current", "A", "current", sensors.current.quantum, {}},
      force{"force", "N", "force", sensors.force.quantum, {}},
      hinge{"joint position", "rad", "position", sensors.joint_position.quantum, {}},
      slide{"joint position", "m", "position", sensors.joint_position.quantum, {}};
  for (const MuscleModel& muscle : robot.muscles) {
    for (CountedKind* kind : {&position, &velocity, &current, &force}) {
      kind->places.push_back(muscle.name);
    }
  }
  for (const JointModel& joint : robot.skeleton->joints) {
    if (joint.type == JointType::kHinge) hinge.places.push_back(joint.name);
    if (joint.type == JointType::kPrismatic) slide.places.push_back(joint.name);
  }
  return {position, velocity, current, force, hinge, slide};
}

/// The largest of all recordings.
double count_of(const std::string& column, const std::vector<Dataset*>& recordings) {
  double largest = 0.0;
  for (const Dataset* recording : recordings) {
    largest = std::max(largest, resolution_of(recording->series(column).values));
  }
  return largest;
}

}  // namespace

void report_counts(const RobotModel& robot, Description& description) {
  const std::vector<Dataset*> recordings = recordings_of(description.question);
  const double alike = description.question.options.measurement.hold.alike;
  const auto is_alike = [&](double a, double b) { return std::abs(a - b) <= alike * b; };
  for (const CountedKind& kind : counted_kinds(robot)) {
    std::map<std::string, double> counts;  // by place
    for (const std::string& place : kind.places) {
      const double count = count_of(place + "/" + kind.quantity, recordings);
      if (count > 0.0 && !is_alike(count, kind.known)) counts[place] = count;
    }
    if (counts.empty()) continue;
    const bool is_all = counts.size() == kind.places.size() &&
                        std::all_of(counts.begin(), counts.end(), [&](const auto& entry) {
                          return is_alike(entry.second, counts.begin()->second);
                        });
    if (is_all) counts = {{"all", counts.begin()->second}};
    for (const auto& [place, count] : counts) {
      description.measurement.push_back(
          {kind.kind, place, "count", count, {count, count}, kind.unit, "found"});
      description.remarks.push_back(
          (is_all ? "all of kind " + kind.kind : place + "/" + kind.quantity) + ": in steps of " +
          significant(count, 3) + " " + kind.unit + ": part of the floor");
    }
  }
}

}  // namespace discovery
}  // namespace anthrob
