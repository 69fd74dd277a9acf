#include "muscle_row.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace {

// [s] of commands. A motor whose time-out ran out just before the first of them is enabled by then.
constexpr double kSettling = 0.3;
// [s] in which any command that is taken over shows in the states.
constexpr double kAnswer = 0.6;

bool nearly_equal(double a, double b) {
  // Motor units hold references as float.
  return std::abs(a - b) <= 1e-3 * std::max(1.0, std::abs(b));
}

}  // namespace

MuscleRow::MuscleRow(const MuscleReading& reading, const ReferenceLimits& limits)
    : reading_(reading), limits_(limits) {
  follow_measurement();
}

void MuscleRow::hear(const MuscleReading& reading, double now) {
  reading_ = reading;
  if (!active()) return follow_measurement();
  followed_ = followed_ || (first_ && reading.state == EcuState::kEnabled);
  if (reading.state == EcuState::kFault) {
    end("fault");
  } else if (robot_stopped_it(now)) {
    end("the robot stopped this motor");
  }
}

void MuscleRow::set_limits(const ReferenceLimits& limits) {
  limits_ = limits;
  if (!active()) follow_measurement();
}

void MuscleRow::set_mode(ControlMode mode) {
  if (mode == mode_) return;
  let_go();
  mode_ = mode;
  follow_measurement();
}

void MuscleRow::set_target(double target) {
  if (active() && std::isfinite(target)) target_ = range_.clipped(target);
}

void MuscleRow::press() {
  begin(pressed_);
}

void MuscleRow::release() {
  pressed_ = false;
}

void MuscleRow::hold(bool held) {
  ended_.reset();
  if (held) {
    begin(held_);
  } else {
    held_ = false;
  }
}

void MuscleRow::begin(bool& by) {
  if (active()) {
    by = true;
    return;
  }
  follow_measurement();
  first_.reset(), last_.reset(), followed_ = false;
  ended_ = cannot_begin();
  by = !ended_;
}

std::optional<std::string> MuscleRow::cannot_begin() const {
  if (reading_.state == EcuState::kFault) return "fault";
  if (mode_ == ControlMode::kPosition && !std::isfinite(reading_.position)) {
    return "no measured position to begin with";
  }
  if (mode_ == ControlMode::kForce && !std::isfinite(reading_.force)) return "no force sensor";
  return std::nullopt;
}

void MuscleRow::end(const std::string& why) {
  let_go();
  ended_ = why;
}

void MuscleRow::let_go() {
  pressed_ = held_ = false;
  ended_.reset();
}

/// VOLTAGE begins at zero: what the control law put out for another mode is no reference.
void MuscleRow::follow_measurement() {
  const double now_measured = measured(reading_, mode_);
  const bool begins_there = mode_ != ControlMode::kVoltage && std::isfinite(now_measured);
  const double begin = begins_there ? now_measured : 0.0;
  const ReferenceRange own = limits_.of(mode_);
  range_ = mode_ == ControlMode::kPosition ? own.with(begin) : own;
  target_ = range_.clipped(begin);
}

bool MuscleRow::robot_stopped_it(double now) const {
  return followed_ && reading_.state != EcuState::kEnabled && first_ && now - *first_ > kSettling;
}

Reference MuscleRow::take(double now) {
  if (!first_) first_ = now;
  if (!last_ || sent_ != target_) {
    sent_ = target_;
    last_ = now;
  }
  return {reading_.name, mode_, target_};
}

bool MuscleRow::follows() const {
  return reading_.mode == static_cast<int>(mode_) && nearly_equal(reading_.reference, sent_);
}

std::optional<std::string> MuscleRow::remark(double now) const {
  if (!active()) return ended_;
  if (!last_ || now - *last_ < kAnswer) return std::nullopt;
  if (reading_.state != EcuState::kEnabled) return "not enabled: press Enable";
  if (!follows()) return "not followed: refused, or another node commands it";
  return std::nullopt;
}

Light MuscleRow::light(bool fresh) const {
  if (!fresh) return Light::kStale;
  if (reading_.state == EcuState::kFault) return Light::kFault;
  return reading_.state == EcuState::kEnabled ? Light::kEnabled : Light::kDisabled;
}

std::string name_of(EcuState state) {
  switch (state) {
    case EcuState::kBoot:
      return "boot";
    case EcuState::kIdle:
      return "idle";
    case EcuState::kEnabled:
      return "enabled";
    case EcuState::kStopping:
      return "stopping";
    case EcuState::kFault:
      return "fault";
  }
  return "unknown";
}

}  // namespace anthrob
