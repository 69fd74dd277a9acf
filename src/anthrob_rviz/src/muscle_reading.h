#pragma once

#include <string>
#include <vector>

#include "control_mode.h"

namespace anthrob {

/// The states of docs/ros.md, with their values in messages.
enum class EcuState { kBoot = 0, kIdle = 1, kEnabled = 2, kStopping = 3, kFault = 4 };

/// One muscle of a message muscle_states. What was not measured is NaN.
struct MuscleReading {
  std::string name;
  double position = 0.0;   ///< [rad]
  double voltage = 0.0;    ///< [V]
  double force = 0.0;      ///< [N]
  double reference = 0.0;  ///< by mode
  int mode = 0;            ///< as in the message, where CURRENT may stand too
  EcuState state = EcuState::kBoot;
};
using MuscleReadings = std::vector<MuscleReading>;

/// What is measured of the quantity that a mode commands.
double measured(const MuscleReading& reading, ControlMode mode);

}  // namespace anthrob
