#pragma once

#include <array>
#include <string>

namespace anthrob {

/// What a muscle's reference is. The values are those of anthrob_msgs/MuscleCommand.
enum class ControlMode { kVoltage = 0, kPosition = 1, kForce = 3 };

/// Those that the panel offers, in its order. CURRENT is left out: a current that is held moves a
/// slack tendon as fast as the motor turns.
constexpr std::array<ControlMode, 3> kControlModes = {ControlMode::kPosition, ControlMode::kForce,
                                                      ControlMode::kVoltage};

std::string name_of(ControlMode mode);  ///< "POSITION"
std::string unit_of(ControlMode mode);  ///< "rad"

/// The unit of any mode of a message, also of one that the panel does not offer.
std::string unit_of_message_mode(int mode);

}  // namespace anthrob
