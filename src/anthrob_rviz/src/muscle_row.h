#pragma once

#include <optional>
#include <string>

#include "muscle_reading.h"
#include "reference_limits.h"

namespace anthrob {

/// What goes into a muscle_command.
struct Reference {
  std::string muscle;
  ControlMode mode = ControlMode::kPosition;
  double value = 0.0;
};

enum class Light { kEnabled, kDisabled, kFault, kStale };

/// One muscle as the panel has it: what is measured, what its user asks for, and whether that is
/// sent. While nothing is sent the target follows the measurement, so that a command begins where
/// the muscle is.
class MuscleRow {
 public:
  MuscleRow(const MuscleReading& reading, const ReferenceLimits& limits);

  void hear(const MuscleReading& reading, double now);
  void set_limits(const ReferenceLimits& limits);
  /// Ends a hold: the old target means nothing in the new mode.
  void set_mode(ControlMode mode);
  /// Without effect while nothing is sent.
  void set_target(double target);
  void press();
  void release();
  /// Sends nothing in a fault, or where nothing is measured to begin with; ended() says so.
  void hold(bool held);
  /// Neither pressed nor held any more.
  void let_go();
  /// The target, which is to be sent now.
  Reference take(double now);

  const MuscleReading& reading() const { return reading_; }
  ControlMode mode() const { return mode_; }
  double target() const { return target_; }
  ReferenceRange range() const { return range_; }
  bool held() const { return held_; }
  /// Its commands are repeated.
  bool active() const { return held_ || pressed_; }
  /// Why the last hold ended by itself; none if it did not.
  const std::optional<std::string>& ended() const { return ended_; }
  /// What its user should know; none if all is well.
  std::optional<std::string> remark(double now) const;
  Light light(bool fresh) const;

 private:
  std::optional<std::string> cannot_begin() const;
  void begin(bool& by);
  void end(const std::string& why);
  void follow_measurement();
  bool robot_stopped_it(double now) const;
  bool follows() const;

  MuscleReading reading_;
  ReferenceLimits limits_;
  ControlMode mode_ = ControlMode::kPosition;
  ReferenceRange range_;
  double target_ = 0.0;
  bool pressed_ = false, held_ = false;
  bool followed_ = false;               ///< was enabled since the first command
  std::optional<double> first_, last_;  ///< when a command, and when another target, was first sent
  double sent_ = 0.0;
  std::optional<std::string> ended_;
};

/// "enabled", "fault", ...
std::string name_of(EcuState state);

}  // namespace anthrob
