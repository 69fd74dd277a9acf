#include "twin/timeline.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace twin {
namespace {

struct Stamped {
  Nanoseconds stamp = 0;
};

Timeline<Stamped> timeline_of(const std::vector<Nanoseconds>& stamps, std::size_t capacity = 8) {
  Timeline<Stamped> timeline({}, capacity);
  for (const Nanoseconds stamp : stamps) timeline.insert({stamp});
  return timeline;
}

std::vector<Nanoseconds> stamps_of(const Timeline<Stamped>& timeline) {
  std::vector<Nanoseconds> stamps;
  for (std::size_t i = 0; i < timeline.size(); ++i) stamps.push_back(timeline[i].stamp);
  return stamps;
}

TEST(Timeline, SortsWhatComesLate) {
  const auto timeline = timeline_of({10, 40, 20, 30, 5});
  EXPECT_EQ(stamps_of(timeline), (std::vector<Nanoseconds>{5, 10, 20, 30, 40}));
  EXPECT_TRUE(timeline.holds(30));
  EXPECT_FALSE(timeline.holds(31));
  EXPECT_EQ(timeline.newest().stamp, 40);
}

TEST(Timeline, ForgetsTheOldest) {
  auto timeline = timeline_of({10, 20, 30, 40}, 3);
  EXPECT_EQ(stamps_of(timeline), (std::vector<Nanoseconds>{20, 30, 40}));
  timeline.forget_before(35);  // it lies between two
  EXPECT_EQ(stamps_of(timeline), (std::vector<Nanoseconds>{30, 40}));
  timeline.insert({50});
  EXPECT_EQ(stamps_of(timeline), (std::vector<Nanoseconds>{30, 40, 50}));
}

TEST(Timeline, BetweenTwo) {
  const auto timeline = timeline_of({10, 20, 40});
  const auto middle = timeline.between(25);
  EXPECT_EQ(middle.from.stamp, 20);
  EXPECT_EQ(middle.to.stamp, 40);
  EXPECT_DOUBLE_EQ(middle.share, 0.25);
  EXPECT_DOUBLE_EQ(timeline.between(5).share, 0.0);
  EXPECT_EQ(timeline.between(50).from.stamp, 40);
  EXPECT_EQ(timeline[timeline.after(20)].stamp, 20);
  EXPECT_EQ(timeline[timeline.after(21)].stamp, 40);
  EXPECT_EQ(timeline[timeline.after(99)].stamp, 40);
  EXPECT_EQ(timeline[timeline.before(39)].stamp, 20);
}

}  // namespace
}  // namespace twin
}  // namespace anthrob
