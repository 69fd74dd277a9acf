#include "anthrob_ecu/parameters.h"

#include <cstddef>
#include <cstring>

namespace anthrob {
namespace ecu {

// clang-format off
const ParameterInfo kParameters[kParameterCount] = {
    {Parameter::kPositionProportional, "position_proportional", "V/rad", 0, 0, 1000, true, "K_P of position mode"},
    {Parameter::kPositionDerivative, "position_derivative", "Vs/rad", 0, 0, 100, true, "K_D of position mode, on the measured speed"},
    {Parameter::kPositionForceFeedforward, "position_force_feedforward", "V/N", 0, 0, 10, true, "K_f of position mode, on the measured force"},
    {Parameter::kCurrentProportional, "current_proportional", "V/A", 0, 0, 1000, true, "K_P of current mode"},
    {Parameter::kCurrentIntegral, "current_integral", "V/(As)", 0, 0, 1e5f, true, "K_I of current mode"},
    {Parameter::kForceProportional, "force_proportional", "V/N", 0, 0, 100, true, "K_P of force mode"},
    {Parameter::kForceIntegral, "force_integral", "V/(Ns)", 0, 0, 1000, true, "K_I of force mode"},
    {Parameter::kForceDerivative, "force_derivative", "Vs/rad", 0, 0, 100, true, "K_D of force mode, on the measured speed"},
    {Parameter::kForceForceFeedforward, "force_force_feedforward", "V/N", 0, 0, 10, true, "K_f of force mode, on the reference"},
    {Parameter::kVoltageLimit, "voltage_limit", "V", 0, 0, 20, false, "output is clipped to +- this"},
    {Parameter::kPositionLow, "position_low", "rad", 0, -50, 50, false, "lowest position; references are clipped to it, a measurement more than 0.5 rad below is a fault"},
    {Parameter::kPositionHigh, "position_high", "rad", 0, -50, 50, false, "highest position; references are clipped to it, a measurement more than 0.5 rad above is a fault"},
    {Parameter::kCurrentLimit, "current_limit", "A", 0, 0, 20, false, "larger measurements are a fault"},
    {Parameter::kForceLimit, "force_limit", "N", 0, 0, 320, false, "larger measurements are a fault"},
    {Parameter::kSpeedLimit, "speed_limit", "rad/s", 0, 0, 20, false, "larger measurements are a fault"},
    {Parameter::kTemperatureLimit, "temperature_limit", "deg C", 0, 0, 125, false, "larger measurements are a fault"},
    {Parameter::kPositionRate, "position_rate", "rad/s", 0, 0, 1000, false, "fastest change of a position reference"},
    {Parameter::kForceRate, "force_rate", "N/s", 0, 0, 1e5f, false, "fastest change of a force reference"},
    {Parameter::kEncoderScale, "encoder_scale", "rad/count", 1e-4f, 1e-7f, 1, false, "at the gear output"},
    {Parameter::kCurrentGain, "current_gain", "A/count", 0.01f, 1e-6f, 1, false, "of the Hall sensor"},
    {Parameter::kCurrentOffset, "current_offset", "count", 2048, 0, 4095, false, "Hall sensor at 0 A"},
    {Parameter::kForceGain, "force_gain", "N/count", 0, 0, 1, false, "of the strain gauge; 0: there is none, and no force mode"},
    {Parameter::kForceOffset, "force_offset", "count", 0, 0, 4095, false, "strain gauge at 0 N"},
    {Parameter::kFilterOrder, "filter_order", "1", 60, 0, kMaxFilterOrder, false, "of the force's FIR filter"},
};
// clang-format on

ParameterSet::ParameterSet() {
  for (int i = 0; i < kParameterCount; ++i) {
    values_[static_cast<std::size_t>(i)] = kParameters[i].initial;
  }
}

bool ParameterSet::set(int index, float value) {
  if (index < 0 || index >= kParameterCount) return false;
  const ParameterInfo& info = kParameters[index];
  // Written so that NaN is refused too.
  if (!(value >= info.lowest && value <= info.highest)) return false;
  values_[static_cast<std::size_t>(index)] = value;
  return true;
}

ControllerSettings ParameterSet::controller() const {
  ControllerSettings settings;
  settings.period = 0.001;
  settings.voltage_limit = get(Parameter::kVoltageLimit);
  for (const ParameterInfo& info : kParameters) {
    double* gain = gain_of(settings, info.parameter);
    if (gain) *gain = get(info.parameter);
  }
  return settings;
}

double* gain_of(ControllerSettings& settings, Parameter parameter) {
  switch (parameter) {
    case Parameter::kPositionProportional:
      return &settings.position.proportional;
    case Parameter::kPositionDerivative:
      return &settings.position.derivative;
    case Parameter::kPositionForceFeedforward:
      return &settings.position.force_feedforward;
    case Parameter::kCurrentProportional:
      return &settings.current.proportional;
    case Parameter::kCurrentIntegral:
      return &settings.current.integral;
    case Parameter::kForceProportional:
      return &settings.force.proportional;
    case Parameter::kForceIntegral:
      return &settings.force.integral;
    case Parameter::kForceDerivative:
      return &settings.force.derivative;
    case Parameter::kForceForceFeedforward:
      return &settings.force.force_feedforward;
    default:
      return nullptr;
  }
}

std::uint16_t configuration_checksum(const ParameterSet* muscles, int count) {
  std::uint16_t crc = 0xFFFF;
  for (int m = 0; m < count; ++m) {
    for (int i = 0; i < kParameterCount; ++i) {
      const float value = muscles[m].raw(i);
      std::uint32_t bits;
      std::memcpy(&bits, &value, sizeof(bits));
      for (int byte = 0; byte < 4; ++byte) {
        crc = static_cast<std::uint16_t>(crc ^ ((bits >> (8 * byte) & 0xFF) << 8));
        for (int bit = 0; bit < 8; ++bit) {
          crc = static_cast<std::uint16_t>((crc & 0x8000) ? (crc << 1) ^ 0x1021 : crc << 1);
        }
      }
    }
  }
  return crc;
}

}  // namespace ecu
}  // namespace anthrob
