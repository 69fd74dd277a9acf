#include "touch/posture_history.h"

#include <algorithm>

namespace anthrob {

void PostureHistory::add(double time, const Posture& posture) {
  if (!empty() && time < newest_time()) entries_.clear();
  if (!empty() && time == newest_time()) {
    entries_.back().posture = posture;
    return;
  }
  entries_.push_back({time, posture});
  while (entries_.front().time < time - kLength) entries_.pop_front();
}

const PostureHistory::Entry& PostureHistory::entry_at(double time) const {
  const auto later =
      std::upper_bound(entries_.begin(), entries_.end(), time,
                       [](double asked, const Entry& entry) { return asked < entry.time; });
  return later == entries_.begin() ? entries_.front() : *std::prev(later);
}

const Posture& PostureHistory::at(double time) const {
  return entry_at(time).posture;
}

Vec3 PostureHistory::velocity(const Skeleton& skeleton, std::size_t link,
                              const Vec3& point_L) const {
  const Entry& now = entries_.back();
  const Entry& before = entry_at(now.time - kSlope);
  if (!(now.time > before.time)) return Vec3::Zero();
  return (skeleton.pose(link, now.posture) * point_L -
          skeleton.pose(link, before.posture) * point_L) /
         (now.time - before.time);
}

}  // namespace anthrob
