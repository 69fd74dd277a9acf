#include "anthrob_ecu/control_law.h"

namespace anthrob {
namespace ecu {

namespace {

double clip(double value, double limit) {
  return value > limit ? limit : value < -limit ? -limit : value;
}

/// Proportional part and feed-forward given, adds the integral of `rate` without wind-up.
double with_integral(double output, double rate, const ControllerSettings& settings,
                     ControllerMemory& memory) {
  const double grown = memory.integral + rate * settings.period;
  const double total = output + grown;
  const double clipped = clip(total, settings.voltage_limit);
  const bool winds_up = (total > clipped && rate > 0.0) || (total < clipped && rate < 0.0);
  if (!winds_up) memory.integral = clip(grown, settings.voltage_limit);
  return clip(output + memory.integral, settings.voltage_limit);
}

}  // namespace

double control(Mode mode, double reference, const Measurement& measured,
               const ControllerSettings& settings, ControllerMemory& memory) {
  const double number = static_cast<double>(mode);
  if (memory.mode != number) memory = {0.0, number};
  switch (mode) {
    case Mode::kVoltage:
      return clip(reference, settings.voltage_limit);
    case Mode::kPosition: {
      const PositionGains& gains = settings.position;
      return clip(gains.proportional * (reference - measured.position) -
                      gains.derivative * measured.velocity +
                      gains.force_feedforward * measured.force,
                  settings.voltage_limit);
    }
    case Mode::kCurrent: {
      const double error = reference - measured.current;
      return with_integral(settings.current.proportional * error, settings.current.integral * error,
                           settings, memory);
    }
    case Mode::kForce: {
      const ForceGains& gains = settings.force;
      const double error = reference - measured.force;
      return with_integral(gains.force_feedforward * reference + gains.proportional * error -
                               gains.derivative * measured.velocity,
                           gains.integral * error, settings, memory);
    }
  }
  return 0.0;
}

}  // namespace ecu
}  // namespace anthrob
