#pragma once

#include <string>

#include "muscle_reading.h"

namespace anthrob {

inline MuscleReading reading(const std::string& name, double position,
                             EcuState state = EcuState::kEnabled) {
  MuscleReading r;
  r.name = name;
  r.position = position;
  r.voltage = 3.0;
  r.force = 5.0;
  r.mode = static_cast<int>(ControlMode::kPosition);
  r.state = state;
  return r;
}

}  // namespace anthrob
