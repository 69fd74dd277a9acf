#include "watch/tendon_watch.h"

#include <algorithm>
#include <cstdio>

namespace anthrob {
namespace driver {

void TendonWatch::restart() {
  loads_.clear();
  was_held_ = lost_ = slack_ = false;
}

bool TendonWatch::held(double force, double now) {
  if (force < limits_.loaded) {
    loads_.clear();
    return false;
  }
  if (loads_.empty()) loaded_since_ = now;
  loads_.push_back({now, force});
  while (now - loads_.front().time > kHeld) loads_.pop_front();
  const auto peak = std::max_element(
      loads_.begin(), loads_.end(), [](const Load& a, const Load& b) { return a.force < b.force; });
  if (now - loaded_since_ < kHeld || force < kSteady * peak->force) return false;
  held_force_ = peak->force;
  return true;
}

bool TendonWatch::torn(double position, double force, double now) {
  if (limits_.loaded <= 0.0) return false;
  if (held(force, now)) {
    was_held_ = true;
    lost_ = false;
    held_time_ = now;
    held_position_ = position;
    return false;
  }
  if (!was_held_) return false;
  const bool slack = force <= limits_.slack;
  const bool let_go = position < held_position_ - kPaidOut;
  const bool too_slow = !lost_ && now - held_time_ > kTear;
  if (let_go || too_slow || (lost_ && !slack)) {
    was_held_ = lost_ = false;
    return false;
  }
  if (!slack) return false;
  if (!lost_) lost_time_ = now;
  lost_ = true;
  return now - lost_time_ >= kConfirm;
}

bool TendonWatch::runs_free(double position, double force, bool pulled) {
  const bool slack = pulled && force <= limits_.slack;
  slack_from_ = slack_ && slack ? std::min(slack_from_, position) : position;
  slack_ = slack;
  return limits_.travel > 0.0 && position - slack_from_ > limits_.travel;
}

std::optional<std::string> TendonWatch::step(double position, double force, bool pulled,
                                             double now) {
  char text[160] = "";
  const bool is_torn = torn(position, force, now);
  const bool is_free = runs_free(position, force, pulled);
  if (is_torn) {
    std::snprintf(text, sizeof(text), "held %.1f N, %.2f s later %.1f N: the tendon broke or slips",
                  held_force_, now - held_time_, force);
  } else if (is_free) {
    std::snprintf(text, sizeof(text),
                  "wound in by %.2f rad, but only %.1f N: the tendon is broken or off its pulley",
                  position - slack_from_, force);
  }
  if (!is_torn && !is_free) return std::nullopt;
  restart();
  return text;
}

}  // namespace driver
}  // namespace anthrob
