#pragma once

#include <string>

#include "muscle_reading.h"

namespace anthrob {

/// How many muscles are in which state.
struct RobotSummary {
  int muscles = 0;
  int enabled = 0;
  int faulty = 0;
};
RobotSummary summary_of(const MuscleReadings& readings);

enum class Presence {
  kAbsent,  ///< never heard
  kSilent,  ///< was heard, and no longer is
  kHeard,
};

/// One line about a robot: "/anthrob: 11 muscles, 11 enabled, 0 faulty".
std::string state_line(const std::string& robot, Presence presence, const RobotSummary& summary);

}  // namespace anthrob
