#include "gap_watch.h"

namespace anthrob {

void GapWatch::note(const std::string& what, double gap) {
  if (gap <= largest_) return;
  largest_ = gap;
  what_ = what;
}

void GapWatch::see(const std::string& what, double stamp) {
  const auto last = last_.find(what);
  if (last == last_.end()) return;
  note(what, stamp - last->second);
  last->second = stamp;
}

void GapWatch::finish(double time) {
  for (const auto& [what, last] : last_) note(what, time - last);
}

}  // namespace anthrob
