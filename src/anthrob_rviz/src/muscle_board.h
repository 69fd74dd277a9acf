#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dead_man.h"
#include "muscle_row.h"

namespace anthrob {

/// All muscles of a robot, and what is to be sent to it. Nothing is sent unless a row is pressed or
/// held; when the panel hides or the robot falls silent, all holds end.
class MuscleBoard {
 public:
  /// @return whether the rows are those of other muscles now
  bool hear(const MuscleReadings& readings, double now);
  void set_limits(const ReferenceLimits& limits);
  /// Ends all holds when it hides.
  void show(bool visible);
  /// Of another robot; ends all holds.
  void clear();

  std::vector<MuscleRow>& rows() { return rows_; }
  const std::vector<MuscleRow>& rows() const { return rows_; }
  void hold_all(bool held);
  /// All muscles stay at their measured positions.
  void hold_here();
  /// Zero volts for all muscles: they yield as far as their gears let them, and nothing winds.
  void relax_all();
  /// FORCE for all muscles: at least 5 N, the pretension at which tendons lie in their pulleys.
  void tighten_all();

  /// What is to be repeated from now on; empty if nothing is.
  std::vector<Reference> take(double now);
  /// Until when, if nobody asks again.
  double deadline(double now) const { return dead_man_.deadline(now); }
  /// Why the last holds ended all at once; none since something is held again.
  const std::optional<std::string>& stopped() const { return stopped_; }
  bool any_active() const;
  bool all_held() const;
  bool fresh(double now) const { return dead_man_.fresh(now); }

 private:
  void hold_all_in(ControlMode mode);
  void end_all(const std::string& why);
  bool same_muscles(const MuscleReadings& readings) const;

  DeadMan dead_man_;
  ReferenceLimits limits_;
  std::vector<MuscleRow> rows_;
  std::optional<std::string> stopped_;
};

}  // namespace anthrob
