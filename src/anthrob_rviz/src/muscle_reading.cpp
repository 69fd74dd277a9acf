#include "muscle_reading.h"

namespace anthrob {

double measured(const MuscleReading& reading, ControlMode mode) {
  switch (mode) {
    case ControlMode::kVoltage:
      return reading.voltage;
    case ControlMode::kPosition:
      return reading.position;
    case ControlMode::kForce:
      return reading.force;
  }
  return reading.position;
}

}  // namespace anthrob
