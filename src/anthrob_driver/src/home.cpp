#include "anthrob_driver/home.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace anthrob {
namespace driver {

namespace {

std::string text(const char* format, double a, double b) {
  char buffer[160];
  std::snprintf(buffer, sizeof(buffer), format, a, b);
  return buffer;
}

}  // namespace

void Home::start(double now) {
  state_ = State::kRunning;
  failure_.clear();
  begun_ = false;
  started_ = settled_ = now;
}

void Home::abort(const std::string& reason) {
  if (!running()) return;
  state_ = State::kFailed;
  failure_ = reason;
}

std::string Home::check(const Reading& reading, Tendon& tendon) const {
  const HomeRoutine& limits = hardware_.home;
  tendon.highest = std::max(tendon.highest, reading.force);
  if (reading.force > limits.force_limit) {
    return text("%.1f N, more than %.1f N: unwind it by hand", reading.force, limits.force_limit);
  }
  const double wound = reading.position - tendon.start;
  const bool tight = reading.force > 0.5 * limits.pretension;
  if (wound > limits.travel_limit && !tight) {
    return text("wound in by %.2f rad and only %.1f N: the tendon is broken or off its pulley",
                wound, reading.force);
  }
  // It held once and then let go.
  const bool held = tendon.highest > 0.8 * limits.pretension;
  if (held && reading.force < (1.0 - limits.slip_drop) * tendon.highest - limits.tolerance) {
    return text("held %.1f N, now %.1f N: the tendon slips or broke", tendon.highest,
                reading.force);
  }
  return "";
}

void Home::step(const std::vector<Reading>& readings, double now) {
  if (state_ != State::kRunning) return;
  if (!begun_) {
    begun_ = true;
    tendons_.assign(readings.size(), Tendon{});
    for (std::size_t i = 0; i < readings.size(); ++i) tendons_[i].start = readings[i].position;
  }
  bool all_tight = true;
  std::string slack;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (std::isnan(readings[i].force)) continue;
    const std::string& name = hardware_.muscles[i].name;
    const std::string wrong = check(readings[i], tendons_[i]);
    if (!wrong.empty()) return abort(name + ": " + wrong);
    const bool tight =
        std::abs(readings[i].force - hardware_.home.pretension) <= hardware_.home.tolerance;
    if (!tight) slack += (slack.empty() ? "" : ", ") + name;
    all_tight = all_tight && tight;
  }
  if (!all_tight) settled_ = now;
  if (now - settled_ >= hardware_.home.settle_time) {
    state_ = State::kReached;
  } else if (now - started_ > hardware_.home.time_limit) {
    abort(text("%.1f s passed and %.1f N were not reached by ", hardware_.home.time_limit,
               hardware_.home.pretension) +
          slack);
  }
}

}  // namespace driver
}  // namespace anthrob
