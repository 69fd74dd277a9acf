#include "watch/muscle_watch.h"

#include <cmath>
#include <cstdio>

namespace anthrob {
namespace driver {

MuscleWatch::MuscleWatch(const MuscleHardware& muscle, const TendonLimits& tendons,
                         double pretension)
    : name_(muscle.name),
      pretension_(pretension),
      tendon_(tendons),
      encoder_(muscle.resistance, muscle.winch.back_emf),
      force_(muscle.winch),
      winding_(muscle.nominal_current, muscle.thermal_time_constant) {}

std::optional<MuscleWatch::Alarm> MuscleWatch::step(const MuscleSample& sample, double time,
                                                    bool enabled, bool homing) {
  if (sample.measured) winding_.step(sample.current, time);
  if (!enabled || homing) {
    tendon_.restart();
    force_.restart();
  }
  if (!enabled) {
    encoder_.restart();
    return std::nullopt;
  }
  if (sample.measured) {
    if (const auto slack = homing ? std::nullopt : tendon(sample, time)) {
      return Alarm{Finding::kTendonSlack, name_ + ": " + *slack, true};
    }
    if (const auto dead = encoder_.step(sample.position, sample.voltage, sample.current, time)) {
      return Alarm{Finding::kEncoderDead, name_ + ": " + *dead, true};
    }
    const auto hard =
        homing ? std::nullopt
               : force_.step(sample.position, sample.velocity, sample.current, sample.force, time);
    if (hard) return Alarm{Finding::kForceImplausible, name_ + ": " + *hard, false};
  }
  if (winding_.relative_temperature_rise() <= WindingTemperatureModel::kLimit) return std::nullopt;
  char text[120];
  std::snprintf(text, sizeof(text),
                ": the estimated heat of its motor is %.2f times that of the nominal current",
                winding_.relative_temperature_rise());
  return Alarm{Finding::kMotorHot, name_ + text, false};
}

std::optional<std::string> MuscleWatch::tendon(const MuscleSample& sample, double time) {
  if (!std::isfinite(sample.force)) return std::nullopt;
  const bool pulled = sample.mode == ecu::Mode::kForce && sample.reference > pretension_;
  return tendon_.step(sample.position, sample.force, pulled, time);
}

std::optional<std::string> MuscleWatch::why_not_enable() const {
  const double wait = winding_.time_to_cool();
  if (wait <= 0.0) return std::nullopt;
  char text[120];
  std::snprintf(text, sizeof(text),
                ": its motor is too hot, judging by its current; try again in %.0f s",
                std::ceil(wait));
  return name_ + text;
}

}  // namespace driver
}  // namespace anthrob
