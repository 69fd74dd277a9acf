#pragma once

#include <deque>
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
  static constexpr double kHeld = 0.2;     ///< [s] for which the load must have been there before
  static constexpr double kTear = 0.08;    ///< [s] of which the unit's force filter takes 0.06
  static constexpr double kConfirm = 0.1;  ///< [s]
  static constexpr double kPaidOut = 0.1;  ///< [rad] paid out: the spindle itself released it
  static constexpr double kSteady = 0.8;   ///< [1] of the load's peak in kHeld: not yet falling

  explicit TendonWatch(const TendonLimits& limits) : limits_(limits) {}

  /// One measurement.
  /// @param position [rad]   @param force [N], finite   @param pulled a FORCE reference above
  /// home's pretension went out with it   @param now [s]
  /// @return what is wrong, in words; empty: nothing
  std::string step(double position, double force, bool pulled, double now);
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
