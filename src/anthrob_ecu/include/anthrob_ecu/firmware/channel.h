#pragma once

#include "anthrob_ecu/control_law.h"
#include "anthrob_ecu/fault.h"
#include "anthrob_ecu/fir_filter.h"
#include "anthrob_ecu/parameters.h"

namespace anthrob {
namespace ecu {

/// Raw readings of one muscle, as the board's peripherals give them.
struct MuscleReadings {
  std::int32_t encoder = 0;      ///< counts
  std::uint16_t current = 2048;  ///< 12-bit counts
  std::uint16_t force = 400;     ///< 12-bit counts
  int temperature = 25;          ///< of the power stage [deg C]
};

/// A condition that must last before it counts.
class Persistence {
 public:
  /// @param ticks below 65536   @return whether the condition has now lasted for `ticks`
  bool lasted(bool condition, int ticks) {
    if (!condition) {
      count_ = 0;
    } else if (count_ < ticks) {
      ++count_;  // saturates, so that a condition that lasts for days does not wrap around to 0
    }
    return count_ >= ticks;
  }

 private:
  std::uint16_t count_ = 0;
};

/// One muscle of an ECU: readings to units, limits, control law.
class Channel {
 public:
  ParameterSet parameters;

  /// Takes the readings of this tick.
  /// @return what is wrong with them
  Fault measure(const MuscleReadings& readings);
  /// One tick of the controller. @return voltage [V]
  double follow();
  /// Zero voltage; the reference is forgotten.
  void release();
  /// @return false if this muscle has no such mode
  bool refer(Mode mode, double reference);
  /// Sets the zero such that the present measurement is `position` [rad].
  void set_position(double position);
  /// Counts were missed, or the tendon has moved on its spindle: the zero is no longer known.
  void lose_zero() { zero_known_ = false; }
  /// Calibration or limits were written: the filter starts again from the next reading.
  void reconfigure();

  const Measurement& measured() const { return measured_; }
  /// Whether set_position() was called, and lose_zero() was not called since.
  bool zero_known() const { return zero_known_; }
  double force_or_nan() const;
  double voltage() const { return voltage_; }
  Mode mode() const { return mode_; }

 private:
  Fault judge(const MuscleReadings& readings);
  bool stands_though_pushed(std::int32_t encoder);
  double towards(double target, double rate) const;

  static constexpr int kSpeedWindow = 8;  ///< [ticks] over which counts are differenced
  Measurement measured_;
  FirFilter<kMaxFilterOrder> force_filter_{kMaxFilterOrder};
  std::int32_t history_[kSpeedWindow] = {};
  int next_ = 0;
  bool started_ = false;
  std::int32_t zero_ = 0;  ///< [counts] where the position is zero_position_
  double zero_position_ = 0.0;
  bool zero_known_ = false;
  std::int32_t last_encoder_ = 0;
  std::int32_t pushed_from_ = 0;  ///< [counts] where it was when the push began, or has moved since
  Mode mode_ = Mode::kVoltage;
  double target_ = 0.0, reference_ = 0.0;
  bool limits_set_ = false;
  double voltage_ = 0.0;
  ControllerMemory memory_;
  ControllerSettings settings_;
  Persistence current_, force_, speed_, force_sensor_, encoder_;
};

}  // namespace ecu
}  // namespace anthrob
