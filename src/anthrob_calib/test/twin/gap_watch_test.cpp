#include "twin/gap_watch.h"

#include <gtest/gtest.h>

#include "twin/moving_robot.h"

namespace anthrob {
namespace twin {
namespace {

/// A report at this time in which the flexor's force has that gap.
GapReport report_of(const Channels& channels, double time, double gap) {
  GapReport report;
  report.stamp = nanoseconds(time);
  report.channels = channels.all.size();
  report.gap.assign(kWindowCount * report.channels * kFeedCount, 1.0);
  for (const Feed feed : kFeeds) report.gap[report.at(kWarningWindow, 0, feed)] = gap;
  return report;
}

TEST(GapWatch, TellsSinceWhen) {
  const auto model = load_robot_model(rig_file());
  const Channels channels(*model, TwinOptions{});
  GapWatch watch(3.0);
  watch.see(channels, report_of(channels, 100.0, 2.9));
  EXPECT_TRUE(watch.warnings().empty());
  for (int t = 101; t <= 131; ++t) watch.see(channels, report_of(channels, t, 6.0));
  ASSERT_EQ(watch.warnings().size(), 1u);
  // A window of 10 s had to pass before the first.
  EXPECT_EQ(watch.warnings()[0].text(), "flexor: 6 floors since 40 s, spring or tendon");
  watch.see(channels, report_of(channels, 132.0, 1.0));
  EXPECT_TRUE(watch.warnings().empty());
}

TEST(GapWatch, BeginsAnewWhenTimeWentBack) {
  const auto model = load_robot_model(rig_file());
  const Channels channels(*model, TwinOptions{});
  GapWatch watch(3.0);
  watch.see(channels, report_of(channels, 100.0, 6.0));
  watch.see(channels, report_of(channels, 20.0, 12.34));
  ASSERT_EQ(watch.warnings().size(), 1u);
  EXPECT_EQ(watch.warnings()[0].text(), "flexor: 12.3 floors since 10 s, spring or tendon");
}

}  // namespace
}  // namespace twin
}  // namespace anthrob
