#pragma once

#include <array>
#include <cstdint>

#include "anthrob_ecu/control_law.h"

namespace anthrob {
namespace ecu {

/// What the host sets up in an ECU, for each muscle; numbers as on the wire.
enum class Parameter : std::uint8_t {
  kPositionProportional,
  kPositionDerivative,
  kPositionForceFeedforward,
  kCurrentProportional,
  kCurrentIntegral,
  kForceProportional,
  kForceIntegral,
  kForceDerivative,
  kForceForceFeedforward,
  kVoltageLimit,
  kPositionLow,
  kPositionHigh,
  kCurrentLimit,
  kForceLimit,
  kSpeedLimit,
  kTemperatureLimit,
  kPositionRate,
  kForceRate,
  kEncoderScale,
  kCurrentGain,
  kCurrentOffset,
  kForceGain,
  kForceOffset,
  kFilterOrder,
};
constexpr int kParameterCount = 24;
/// Writing sets the present position [rad], reading returns it. Not part of the configuration.
constexpr std::uint8_t kPresentPosition = 64;
/// Read: 1 if the unit has a zero from which positions count, else 0. Writing kPresentPosition sets
/// a zero. Power-up, the faults of loses_zero() and writing 0 here remove it. Only 0 may be
/// written. Not part of the configuration.
constexpr std::uint8_t kZeroKnown = 65;

struct ParameterInfo {
  Parameter parameter;
  const char* name;
  const char* unit;
  float initial;  ///< after power-up; deliberately useless, so that nothing moves unconfigured
  float lowest, highest;
  bool live;  ///< may be written while enabled
  const char* meaning;
};

/// One row for each parameter, in the order of their numbers.
extern const ParameterInfo kParameters[kParameterCount];

constexpr int kMaxFilterOrder = 60;

/// The parameters of one muscle.
class ParameterSet {
 public:
  ParameterSet();

  double get(Parameter parameter) const { return values_[static_cast<std::size_t>(parameter)]; }
  float raw(int index) const { return values_[static_cast<std::size_t>(index)]; }
  /// @return false if there is no such parameter or the value is outside its range
  bool set(int index, float value);
  bool set(Parameter parameter, double value) {
    return set(static_cast<int>(parameter), static_cast<float>(value));
  }

  bool has_force_sensor() const { return get(Parameter::kForceGain) > 0.0; }
  ControllerSettings controller() const;

 private:
  std::array<float, kParameterCount> values_;
};

/// @return where `settings` holds this gain; null if the parameter is not a gain
double* gain_of(ControllerSettings& settings, Parameter parameter);

/// CRC-16/CCITT over all parameters of the muscles, in order. Host and ECU compare it to make sure
/// that they hold the same configuration.
std::uint16_t configuration_checksum(const ParameterSet* muscles, int count);

}  // namespace ecu
}  // namespace anthrob
