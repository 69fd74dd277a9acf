#pragma once

#include <optional>
#include <string>

namespace anthrob {

/// Decides when a command may go and when one is due: the dead man of the panel. Time is an
/// argument, [s] of a clock that never jumps.
class CommandRepeater {
 public:
  static constexpr double kPeriod = 0.05;  ///< [s] ten commands within the time-out of the robot
  static constexpr double kStale = 0.5;    ///< [s] states older than this are no states

  void hear(double now) { heard_ = now; }
  void forget() { heard_.reset(); }
  void show(bool visible) { visible_ = visible; }

  /// The robot has published its states within the last half second.
  bool fresh(double now) const { return heard_ && now - *heard_ <= kStale; }
  /// Why nothing may be sent now; none if it may.
  std::optional<std::string> obstacle(double now) const;
  /// Whether a command is to be sent now, by somebody who has one. To be asked more often than one
  /// is due. What was missed is not made up for.
  bool due(double now);

 private:
  std::optional<double> heard_;
  std::optional<double> next_;  ///< when a command is due
  bool visible_ = false;
};

}  // namespace anthrob
