#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "anthrob_ecu/control_law.h"
#include "anthrob_ecu/state_machine.h"

namespace anthrob {
namespace driver {

/// One muscle at one SYNC.
struct MuscleSample {
  bool measured = false;  ///< its ECU answered this SYNC; otherwise the measurements are NaN
  double position = 0.0, velocity = 0.0;  ///< [rad], [rad/s]; gear output, winding in positive
  double current = 0.0;                   ///< [A] motor loop
  double voltage = 0.0;                   ///< [V] output of the controller
  double force = 0.0;                     ///< [N] NaN also if it has no sensor
  double reference = 0.0;                 ///< [V, rad, A or N] sent with this SYNC
  ecu::Mode mode = ecu::Mode::kVoltage;
  ecu::State state = ecu::State::kBoot;  ///< FAULT also if its ECU did not answer
};

/// All muscles at one SYNC.
struct Sample {
  std::int64_t stamp_ns = 0;  ///< wall clock of the kernel when the SYNC was on the wire
  double time = 0.0;          ///< [s] of the driver's clock when the SYNC was sent
  double round_trip = 0.0;    ///< [s] from SYNC and references to the last answer
  std::vector<MuscleSample> muscles;
};

/// Reading of an analogue sensor at one SYNC.
struct AnalogSample {
  enum class Kind { kJoint, kTouch };
  std::int64_t stamp_ns = 0;  ///< as Sample's
  double time = 0.0;          ///< as Sample's
  Kind kind = Kind::kJoint;
  std::size_t sensor = 0;  ///< index in Hardware::joints or touch
  double value = 0.0;      ///< [rad] or [N]
  double rate = 0.0;       ///< [rad/s] of joints; NaN for the first value after a gap
};

}  // namespace driver
}  // namespace anthrob
