#include "twin_reading.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anthrob_core/text.h"

namespace anthrob {

namespace {

constexpr double kMayBeRight = 2.0, kWarned = 4.0;  // [floors]

std::string owner_of(const std::string& channel) {
  return channel.substr(0, channel.rfind('/'));
}

}  // namespace

std::vector<OwnerGap> gaps_by_owner(const GapReading& reading, std::size_t window) {
  std::vector<OwnerGap> owners;
  const std::size_t feeds = reading.feeds.size();
  for (std::size_t c = 0; c < reading.channels.size(); ++c) {
    const std::string owner = owner_of(reading.channels[c]);
    if (owners.empty() || owners.back().owner != owner) {
      owners.push_back(
          {owner, std::vector<double>(feeds, std::numeric_limits<double>::quiet_NaN())});
    }
    for (std::size_t f = 0; f < feeds; ++f) {
      const std::size_t at = (window * reading.channels.size() + c) * feeds + f;
      double& largest = owners.back().gaps[f];
      largest = std::fmax(largest, reading.gaps.at(at));
    }
  }
  return owners;
}

Level level_of_gap(double floors) {
  if (!std::isfinite(floors)) return Level::kStale;
  return floors < kMayBeRight ? Level::kOk : floors < kWarned ? Level::kWarning : Level::kError;
}

std::string text_of(const JobReading& job) {
  if (!job.runs) return job.headline;
  std::vector<std::string> words = {job.stage, significant(100.0 * job.share, 2) + " %"};
  if (std::isfinite(job.seconds_left)) {
    words.push_back("about " + duration_text(job.seconds_left) + " left");
  }
  if (!job.best.empty()) words.push_back("best: " + job.best);
  words.erase(std::remove(words.begin(), words.end(), ""), words.end());
  return joined(words);
}

}  // namespace anthrob
