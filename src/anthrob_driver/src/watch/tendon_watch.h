#pragma once

#include <deque>
#include <optional>
#include <string>

#include "anthrob_driver/hardware.h"

namespace anthrob {
namespace driver {

/// Detects a tendon that breaks, slips or leaves its pulley while its muscle is enabled. A slack
/// tendon alone is no alarm, because antagonists are often slack. Two events are:
/// - torn: a load that was held disappears within kTear, although the spindle did not pay out, and
///   does not come back within kConfirm;
/// - runs free: a force is commanded, and the spindle winds in further and further without force.
class TendonWatch {
 public:
  // Chosen, not measured on a robot. ordinary_motion_test shows no alarm in motions of the emulated
  // Anthrob up to 165 N and 8.4 rad/s; studies/fault_campaign.md says how fast a break stops it.

  /// [s] for which the load must have been there before, so that a short peak is no load
  static constexpr double kHeld = 0.2;
  /// [s] Of these the unit's force filter takes 0.06 (order 60 at 1 kHz). Slower than that, joints
  /// may release a tendon: an arm at 1 rad/s takes 0.33 s for 40 N (tendon_watch_test).
  static constexpr double kTear = 0.08;
  /// [s] After a blow on the arm, the force must have come back within this time.
  static constexpr double kConfirm = 0.1;
  /// [rad] A spindle that paid out more released the tendon itself: 0.65 mm of Anthrob's tendons.
  static constexpr double kPaidOut = 0.1;
  /// [1] of the load's peak in kHeld; below, the load is falling already
  static constexpr double kSteady = 0.8;

  explicit TendonWatch(const TendonLimits& limits) : limits_(limits) {}

  /// One measurement.
  /// @param position [rad]   @param force [N], finite   @param pulled a FORCE reference above
  /// home's pretension went out with it   @param now [s]
  /// @return what is wrong, in words
  std::optional<std::string> step(double position, double force, bool pulled, double now);
  /// Forgets everything; to be called while the muscle is not enabled or `home` watches it.
  void restart();

 private:
  struct Load {
    double time, force;
  };
  bool held(double force, double now);
  bool torn(double position, double force, double now);
  bool runs_free(double position, double force, bool pulled);

  TendonLimits limits_;
  std::deque<Load> loads_;     ///< of the last kHeld, all above limits_.loaded
  double loaded_since_ = 0.0;  ///< [s] the first of them without a gap
  bool was_held_ = false;      ///< the three that follow are known
  double held_time_ = 0.0, held_position_ = 0.0, held_force_ = 0.0;
  bool lost_ = false;  ///< within kTear of being held
  double lost_time_ = 0.0;
  bool slack_ = false;       ///< though pulled
  double slack_from_ = 0.0;  ///< [rad] lowest position since
};

}  // namespace driver
}  // namespace anthrob
