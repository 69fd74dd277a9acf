#include "scope/samples.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

constexpr Nanoseconds kTick = 2000000;  // 500 Hz

TEST(SampleWindowTest, KeepsAllOfItsWidthAndNothingElse) {
  SampleWindow window(60000000000);
  for (int i = 0; i < 100000; ++i) {
    window.add({i * kTick, static_cast<double>(i)});
    const auto kept = static_cast<std::size_t>(std::min(i, 30000)) + 1;
    ASSERT_EQ(window.span().size(), kept) << i;
    ASSERT_EQ(window.span().back().value, i);
  }
  for (std::size_t i = 0; i < window.span().size(); ++i) {
    ASSERT_EQ(window.span().begin()[i].value, 69999.0 + static_cast<double>(i));
  }
}

TEST(SampleWindowTest, DoesNotGrowOnceItIsFull) {
  SampleWindow window(60000000000);
  std::size_t bytes = 0;
  for (int i = 0; i < 1000000; ++i) {
    window.add({i * kTick, 0.0});
    if (i == 100000) bytes = window.bytes();
  }
  EXPECT_EQ(window.bytes(), bytes);
  EXPECT_LE(bytes, 4 * 30001 * sizeof(Sample));
}

TEST(SampleWindowTest, PutsALateSampleInItsPlace) {
  SampleWindow window(60000000000);
  for (const Nanoseconds t : {0, 100000000, 300000000, 200000000, 300000000})
    window.add({t, 1e-9 * static_cast<double>(t)});
  const SampleSpan span = window.span();
  ASSERT_EQ(span.size(), 5U);
  for (std::size_t i = 1; i < span.size(); ++i) EXPECT_LE(span.begin()[i - 1].t, span.begin()[i].t);
}

TEST(SampleWindowTest, BeginsAnewWhenTheClockIsPutBack) {
  SampleWindow window(60000000000);
  window.add({10000000000, 1.0});
  window.add({9000000000, 2.0});
  ASSERT_EQ(window.span().size(), 1U);
  EXPECT_EQ(window.span().front().value, 2.0);
}

}  // namespace
}  // namespace anthrob
