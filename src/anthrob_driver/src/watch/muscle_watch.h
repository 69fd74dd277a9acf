#pragma once

#include <optional>
#include <string>

#include "anthrob_driver/findings.h"
#include "anthrob_driver/hardware.h"
#include "anthrob_driver/link/sample.h"
#include "watch/encoder_watch.h"
#include "watch/force_watch.h"
#include "watch/tendon_watch.h"
#include "watch/winding_temperature_model.h"

namespace anthrob {
namespace driver {

/// Watches one muscle: its tendon, its encoder, its force sensor and its motor's winding.
class MuscleWatch {
 public:
  /// Reason to stop all motors.
  struct Alarm {
    Finding finding;
    std::string detail;  ///< which muscle, and what is wrong with it
    bool zero_lost;      ///< its zero is no longer known
  };

  /// @param muscle, tendons, pretension [N] of home, as they are wired
  MuscleWatch(const MuscleHardware& muscle, const TendonLimits& tendons, double pretension);

  /// Once a cycle.
  /// @param sample may be that of the previous cycle   @param time [s] when it was taken
  /// @param enabled alarms are raised only then; a motor that is off cools down
  /// @param homing whether `home` runs, which watches the tendon itself
  std::optional<Alarm> step(const MuscleSample& sample, double time, bool enabled, bool homing);

  const WindingTemperatureModel& winding() const { return winding_; }
  /// Why this muscle prevents enabling, if it does.
  std::optional<std::string> why_not_enable() const;

 private:
  std::optional<std::string> tendon(const MuscleSample& sample, double time);

  std::string name_;
  double pretension_;
  TendonWatch tendon_;
  EncoderWatch encoder_;
  ForceWatch force_;
  WindingTemperatureModel winding_;
};

}  // namespace driver
}  // namespace anthrob
