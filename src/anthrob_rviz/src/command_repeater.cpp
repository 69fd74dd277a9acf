#include "command_repeater.h"

namespace anthrob {

std::optional<std::string> CommandRepeater::obstacle(double now) const {
  if (!visible_) return "the panel was hidden";
  if (!heard_) return "no robot publishes its states";
  if (!fresh(now)) return "the robot's states are older than 0.5 s";
  return std::nullopt;
}

bool CommandRepeater::due(double now) {
  if (obstacle(now)) return false;
  if (next_ && now < *next_) return false;
  // From the time when it was due, so that a late look does not lower the rate.
  const bool in_step = next_ && now - *next_ < kPeriod;
  next_ = (in_step ? *next_ : now) + kPeriod;
  return true;
}

}  // namespace anthrob
