#include "routine/home.h"

#include <cmath>
#include <cstdio>

namespace anthrob {
namespace driver {

namespace {

/// [rad] that a slack tendon may get longer while it is to be wound in.
constexpr double kUnwound = 0.5;

std::string text(const char* format, double a, double b) {
  char buffer[160];
  std::snprintf(buffer, sizeof(buffer), format, a, b);
  return buffer;
}

}  // namespace

void Home::start(double now) {
  state_ = State::kRunning;
  failure_.reset();
  tendons_.clear();
  begun_ = false;
  started_ = settled_ = now;
}

void Home::abort(const std::string& reason) {
  if (!running()) return;
  state_ = State::kFailed;
  failure_ = reason;
}

bool Home::pulls(std::size_t muscle) const {
  return hardware_.muscles[muscle].parameters.has_force_sensor();
}

std::string Home::unknown(const std::vector<Reading>& readings) const {
  std::string names;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const bool known = std::isfinite(readings[i].position) && std::isfinite(readings[i].force);
    if (!pulls(i) || known) continue;
    names += (names.empty() ? "" : ", ") + hardware_.muscles[i].name;
  }
  return names;
}

bool Home::begin(const std::vector<Reading>& readings, double now) {
  // A muscle whose answer is missing would wind from nowhere, and no travel could be measured.
  const std::string missing = unknown(readings);
  if (!missing.empty()) {
    if (now - started_ > hardware_.home.time_limit) {
      abort(missing + ": not measured within time_limit, so home could not start");
    }
    return false;
  }
  begun_ = true;
  started_ = settled_ = now;
  tendons_.assign(readings.size(), Tendon{});
  for (std::size_t i = 0; i < readings.size(); ++i) tendons_[i].start = readings[i].position;
  return true;
}

std::optional<std::string> Home::check_force(const Reading& reading) const {
  if (!std::isfinite(reading.force)) return "its force is no longer measured";
  if (reading.force <= hardware_.home.force_limit) return std::nullopt;
  return text("%.1f N, more than force_limit (%.1f N): unwind it by hand", reading.force,
              hardware_.home.force_limit);
}

std::optional<std::string> Home::check_grip(const Reading& reading, Tendon& tendon) const {
  const double pretension = hardware_.home.pretension;
  if (!tendon.held || reading.force >= (1.0 - hardware_.home.slip_drop) * pretension)
    return std::nullopt;
  tendon.lost = true;
  return text("held %.1f N, now %.1f N: the tendon slips or broke", pretension, reading.force);
}

std::optional<std::string> Home::check(const Reading& reading, Tendon& tendon) const {
  const HomeRoutine& limits = hardware_.home;
  const double pretension = limits.pretension;
  if (const auto wrong = check_force(reading)) return wrong;
  const double wound = reading.position - tendon.start;
  const bool grips = reading.force > 0.5 * pretension;
  // One that was tight at the start may pay out down to the pretension, and holds that then.
  if (wound < -kUnwound && !grips && !tendon.held) {
    return text(
        "winds the wrong way, from %.2f to %.2f rad: check the polarity of motor and encoder",
        tendon.start, reading.position);
  }
  if (wound > limits.travel_limit && !grips) {
    tendon.lost = true;
    return text("wound in by %.2f rad, but only %.1f N: the tendon is broken or off its pulley",
                wound, reading.force);
  }
  if (grips && !tendon.gripped) tendon.grip = reading.position;
  tendon.gripped = tendon.gripped || grips;
  // By force control from here on, which a sensor that always reads the same would lead anywhere.
  const double turned = reading.position - tendon.grip;
  if (tendon.gripped && std::abs(turned) > limits.travel_limit) {
    return text(
        "turned by %.2f rad since its tendon gripped, and reads %.1f N: the force sensor does not "
        "follow",
        turned, reading.force);
  }
  tendon.held = tendon.held || reading.force > 0.8 * pretension;
  return check_grip(reading, tendon);
}

void Home::hold(const std::vector<Reading>& readings) {
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!pulls(i) || !std::isfinite(readings[i].position)) continue;
    auto wrong = check_force(readings[i]);
    if (!wrong) wrong = check_grip(readings[i], tendons_[i]);
    if (wrong) return abort(hardware_.muscles[i].name + ": " + *wrong);
  }
}

ecu::MuscleReference Home::command(std::size_t muscle, double now) const {
  const int index = static_cast<int>(muscle);
  if (!begun_ || !pulls(muscle)) {
    return {index, ecu::Mode::kVoltage, 0.0};
  }
  // Force control from slack on would race through the slack and overshoot.
  const Tendon& tendon = tendons_[muscle];
  if (tendon.gripped) return {index, ecu::Mode::kForce, hardware_.home.pretension};
  return {index, ecu::Mode::kPosition, tendon.start + hardware_.home.wind_speed * (now - started_)};
}

void Home::step(const std::vector<Reading>& readings, double now) {
  if (state_ != State::kRunning) return;
  if (!begun_ && !begin(readings, now)) return;
  bool all_tight = true;
  std::string slack;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    // One answer may be missing; an ECU that is lost ends homing elsewhere.
    if (!pulls(i) || !std::isfinite(readings[i].position)) continue;
    const std::string& name = hardware_.muscles[i].name;
    const auto wrong = check(readings[i], tendons_[i]);
    if (wrong) return abort(name + ": " + *wrong);
    const bool tight =
        std::abs(readings[i].force - hardware_.home.pretension) <= hardware_.home.tolerance;
    if (!tight) slack += (slack.empty() ? "" : ", ") + name;
    all_tight = all_tight && tight;
  }
  if (!all_tight) settled_ = now;
  if (now - settled_ >= hardware_.home.settle_time) {
    state_ = State::kReached;
  } else if (now - started_ > hardware_.home.time_limit) {
    // What never gripped, because its position_range ends or its motor does not turn, has no zero.
    for (std::size_t i = 0; i < readings.size(); ++i) {
      tendons_[i].lost = tendons_[i].lost || (pulls(i) && !tendons_[i].gripped);
    }
    const char* const what =
        slack.empty() ? "after %.1f s (time_limit) not all muscles had held %.1f N for settle_time"
                      : "after %.1f s (time_limit) %.1f N were not reached by ";
    abort(text(what, hardware_.home.time_limit, hardware_.home.pretension) + slack);
  }
}

}  // namespace driver
}  // namespace anthrob
