#pragma once

#include <optional>
#include <string>

namespace anthrob {

/// Whether anything may be sent: only while the panel is seen and the robot is heard. Time is an
/// argument, [s] of a clock that never jumps.
class DeadMan {
 public:
  static constexpr double kStale = 0.5;  ///< [s] states older than this are no states
  static constexpr double kHung = 0.3;   ///< [s] a GUI that did nothing for so long hangs

  void hear(double now) { heard_ = now; }
  void forget() { heard_.reset(); }
  void show(bool visible) { visible_ = visible; }

  /// The robot has published its states within the last half second.
  bool fresh(double now) const { return heard_ && now - *heard_ <= kStale; }
  /// Why nothing may be sent now; none if it may.
  std::optional<std::string> obstacle(double now) const;
  /// Until when a command may be repeated, if nobody looks again. To be asked without obstacle.
  double deadline(double now) const;

 private:
  std::optional<double> heard_;
  bool visible_ = false;
};

}  // namespace anthrob
