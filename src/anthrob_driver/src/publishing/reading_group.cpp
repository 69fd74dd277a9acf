#include "publishing/reading_group.h"

#include <algorithm>

namespace anthrob {
namespace driver {

std::vector<AnalogSample> ReadingGroup::add(const AnalogSample& reading) {
  std::vector<AnalogSample> done;
  if (!pending_.empty() && pending_.front().time != reading.time) done.swap(pending_);
  const auto behind = [](const AnalogSample& a, const AnalogSample& b) {
    return a.sensor < b.sensor;
  };
  pending_.insert(std::upper_bound(pending_.begin(), pending_.end(), reading, behind), reading);
  // An instant that is past has more than one sensor, so this one is not complete, too.
  if (pending_.size() >= sensors_) done.swap(pending_);
  return done;
}

}  // namespace driver
}  // namespace anthrob
