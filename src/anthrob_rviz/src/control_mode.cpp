#include "control_mode.h"

namespace anthrob {

std::string name_of(ControlMode mode) {
  switch (mode) {
    case ControlMode::kVoltage:
      return "VOLTAGE";
    case ControlMode::kPosition:
      return "POSITION";
    case ControlMode::kForce:
      return "FORCE";
  }
  return "unknown";
}

std::string unit_of_message_mode(int mode) {
  static const std::array<const char*, 4> kUnits = {"V", "rad", "A", "N"};
  return mode >= 0 && mode < 4 ? kUnits[static_cast<std::size_t>(mode)] : "?";
}

std::string unit_of(ControlMode mode) {
  return unit_of_message_mode(static_cast<int>(mode));
}

}  // namespace anthrob
