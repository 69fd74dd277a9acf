#include "watch/force_watch.h"

#include <cmath>
#include <cstdio>

namespace anthrob {
namespace driver {

namespace {

constexpr double kLongestGap = 0.05;  // [s] between two measurements

}  // namespace

std::optional<std::string> ForceWatch::step(double position, double speed, double current,
                                            double force, double now) {
  if (winch_.back_emf <= 0.0 || winch_.radius <= 0.0 || !std::isfinite(force)) return std::nullopt;
  if (count_ == 0 || now - last_ > kLongestGap) {
    count_ = 0;
    since_ = now;
    position_ = position;
    speed_ = speed;
    currents_ = forces_ = 0.0;
  }
  last_ = now;
  ++count_;
  currents_ += current;
  forces_ += force;
  if (now - since_ < kLasts) return std::nullopt;
  const double mean_current = currents_ / count_, mean_force = forces_ / count_;
  const double acceleration = (speed - speed_) / (now - since_);
  count_ = 0;  // looked at; anew from the next measurement on
  if (position - position_ < kWindsIn) return std::nullopt;
  const double pull =
      (winch_.back_emf * mean_current - winch_.inertia * acceleration) / winch_.radius;
  if (!(pull > kLosses * mean_force + kExcess)) return std::nullopt;
  char text[120];
  std::snprintf(text, sizeof(text), "at %.2f A its motor pulls with up to %.0f N, and reads %.1f N",
                mean_current, pull, mean_force);
  return text;
}

}  // namespace driver
}  // namespace anthrob
