#pragma once

#include <optional>
#include <string>

#include "anthrob_driver/hardware.h"

namespace anthrob {
namespace driver {

/// Detects a motor that pulls much harder than its force sensor reads. What its current does not
/// spend on acceleration pulls the tendon,
///   T = k I - J dw/dt   [Nm] at the gear output
/// and a tendon of force F takes r F of it. If T is more than r (kLosses F + kExcess) over kLasts,
/// in which the spindle winds in, the force sensor stands still: FORCE control would pull harder
/// and harder. A spindle that stands may be jammed; its unit finds that (fault `encoder`).
class ForceWatch {
 public:
  // Chosen, not measured on a robot. ordinary_motion_test shows no alarm in motions of the emulated
  // Anthrob; studies/fault_campaign.md says how fast a sensor that stands still stops it.

  /// [s] The unit's force filter is 0.03 s late (order 60 at 1 kHz).
  static constexpr double kLasts = 0.1;
  /// [1] A gear that passes on 0.6, and friction along the tendon that takes half of that.
  static constexpr double kLosses = 4.0;
  /// [N] Allows for the friction of motor and gear without load.
  static constexpr double kExcess = 100.0;
  /// [rad] within kLasts; 0.1 mm of Anthrob's tendons
  static constexpr double kWindsIn = 0.02;

  explicit ForceWatch(const Winch& winch) : winch_(winch) {}

  /// One measurement.
  /// @param position [rad]   @param speed [rad/s]   @param current [A]
  /// @param force [N]; NaN: no sensor   @param now [s]
  /// @return what is wrong, in words
  std::optional<std::string> step(double position, double speed, double current, double force,
                                  double now);
  /// Forgets everything; to be called while the muscle is not enabled or `home` watches it.
  void restart() { count_ = 0; }

 private:
  Winch winch_;
  int count_ = 0;                         ///< measurements since since_
  double since_ = 0.0, last_ = 0.0;       ///< [s]
  double position_ = 0.0, speed_ = 0.0;   ///< [rad], [rad/s] at since_
  double currents_ = 0.0, forces_ = 0.0;  ///< sums since then [A], [N]
};

}  // namespace driver
}  // namespace anthrob
