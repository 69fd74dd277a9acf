#include "command_repeater.h"

#include <utility>

namespace anthrob {

void CommandRepeater::set(std::vector<Reference> references, double deadline) {
  references_ = std::move(references);
  deadline_ = deadline;
}

std::vector<Reference> CommandRepeater::take_due(double now) {
  if (references_.empty() || now > deadline_) return {};
  if (next_ && now < *next_) return {};
  // From the time when it was due, so that a late look does not lower the rate.
  const bool in_step = next_ && now - *next_ < kPeriod;
  next_ = (in_step ? *next_ : now) + kPeriod;
  return references_;
}

}  // namespace anthrob
