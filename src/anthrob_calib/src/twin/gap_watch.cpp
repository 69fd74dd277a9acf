#include "twin/gap_watch.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/text.h"

namespace anthrob {
namespace twin {

std::string GapWatch::Warning::text() const {
  return finding.owner + ": " + significant(finding.gap, finding.gap < 10.0 ? 2 : 3) +
         " floors since " + duration_text(seconds(now - since)) + ", " + words(finding.part);
}

void GapWatch::see(const Channels& channels, const GapReport& report) {
  if (report.stamp < last_) warnings_.clear();
  last_ = report.stamp;
  const std::size_t size = report.channels * kFeedCount;
  const auto first = report.gap.begin() + static_cast<std::ptrdiff_t>(size * kWarningWindow);
  const std::vector<double> gap(first, first + static_cast<std::ptrdiff_t>(size));
  std::vector<Warning> now;
  for (const Finding& finding : judge(channels.all, gap, warn_)) {
    const auto known =
        std::find_if(warnings_.begin(), warnings_.end(), [&](const Warning& warning) {
          return warning.finding.owner == finding.owner && warning.finding.part == finding.part;
        });
    // Over a window that had to pass first.
    const Nanoseconds since = known != warnings_.end()
                                  ? known->since
                                  : report.stamp - nanoseconds(kWindowBlocks[kWarningWindow]);
    now.push_back({finding, since, report.stamp});
  }
  warnings_ = now;
}

}  // namespace twin
}  // namespace anthrob
