#include "robot_summary.h"

namespace anthrob {

RobotSummary summary_of(const MuscleReadings& readings) {
  RobotSummary summary;
  summary.muscles = static_cast<int>(readings.size());
  for (const MuscleReading& reading : readings) {
    if (reading.state == EcuState::kEnabled) ++summary.enabled;
    if (reading.state == EcuState::kFault) ++summary.faulty;
  }
  return summary;
}

std::string state_line(const std::string& robot, Presence presence, const RobotSummary& summary) {
  if (presence == Presence::kAbsent) return "no robot at " + robot + ": nothing is commanded";
  const std::string counts = std::to_string(summary.muscles) + " muscles, " +
                             std::to_string(summary.enabled) + " enabled, " +
                             std::to_string(summary.faulty) + " faulty";
  if (presence == Presence::kSilent) return robot + " is silent; at last " + counts;
  return robot + ": " + counts;
}

}  // namespace anthrob
