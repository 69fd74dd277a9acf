#include "playback.h"

#include <algorithm>
#include <utility>

namespace anthrob {

void Playback::seek(double position) {
  position_ = std::clamp(position, 0.0, duration_);
  jumped_ = true;
}

Playback::Step Playback::advance(double time) {
  if (std::exchange(jumped_, false)) return Step::kJumped;
  if (paused_) return Step::kOn;
  if (position_ >= duration_) {
    if (!options_.loop) return Step::kEnded;
    position_ = 0.0;
    return Step::kJumped;
  }
  position_ = std::min(position_ + options_.rate * time, duration_);
  return Step::kOn;
}

}  // namespace anthrob
