#pragma once

#include <cstdint>

namespace anthrob {
namespace ecu {

/// Control modes; numbers as on the wire and in MuscleCommand.
enum class Mode : std::uint8_t { kVoltage = 0, kPosition = 1, kCurrent = 2, kForce = 3 };
constexpr int kModeCount = 4;

/// What the controller knows of its muscle.
struct Measurement {
  double position = 0.0;  ///< gear output, winding in positive [rad]
  double velocity = 0.0;  ///< [rad/s]
  double current = 0.0;   ///< [A]
  double force = 0.0;     ///< [N]
};

struct PositionGains {
  double proportional = 0.0;       ///< K_P [V/rad]
  double derivative = 0.0;         ///< K_D, on the measured speed [Vs/rad]
  double force_feedforward = 0.0;  ///< K_f, on the measured force [V/N]
};

struct CurrentGains {
  double proportional = 0.0;  ///< [V/A]
  double integral = 0.0;      ///< [V/(As)]
};

struct ForceGains {
  double proportional = 0.0;       ///< [V/N]
  double integral = 0.0;           ///< [V/(Ns)]
  double derivative = 0.0;         ///< on the measured speed [Vs/rad]
  double force_feedforward = 0.0;  ///< on the reference [V/N]
};

struct ControllerSettings {
  double period = 0.001;       ///< [s]
  double voltage_limit = 0.0;  ///< [V]
  PositionGains position;
  CurrentGains current;
  ForceGains force;
};

/// What a controller remembers between two ticks.
struct ControllerMemory {
  double integral = 0.0;  ///< integral part of the output [V]
  double mode = 0.0;      ///< mode of the last tick
};

/// One tick of the control laws of section 7.3.1 (Figure 7.10):
///   voltage   V = r
///   position  V = K_P (r - position) - K_D velocity + K_f force
///   current   V = K_P (r - current) + integral of K_I (r - current)
///   force     V = K_f r + K_P (r - force) - K_D velocity + integral of K_I (r - force)
/// clipped to +- voltage_limit. An integral does not grow while the output is clipped in its
/// direction. It belongs to its mode: after a change of mode it starts at zero.
/// @return voltage [V] to hold until the next tick
double control(Mode mode, double reference, const Measurement& measured,
               const ControllerSettings& settings, ControllerMemory& memory);

}  // namespace ecu
}  // namespace anthrob
