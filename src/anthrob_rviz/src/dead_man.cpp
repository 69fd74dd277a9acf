#include "dead_man.h"

#include <algorithm>

namespace anthrob {

std::optional<std::string> DeadMan::obstacle(double now) const {
  if (!visible_) return "the panel was hidden";
  if (!heard_) return "no robot publishes its states";
  if (!fresh(now)) return "the robot's states are older than 0.5 s";
  return std::nullopt;
}

double DeadMan::deadline(double now) const {
  return std::min(now + kHung, heard_.value_or(now) + kStale);
}

}  // namespace anthrob
