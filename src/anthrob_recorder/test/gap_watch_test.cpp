#include "gap_watch.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

GapWatch watch() {
  GapWatch gaps;
  gaps.expect("biceps_brachii", 1.0);
  gaps.expect("shoulder", 1.0);
  return gaps;
}

void see_from(GapWatch& gaps, const std::string& what, double begin, double end) {
  for (double t = begin; t < end; t += 0.01) gaps.see(what, t);
}

TEST(GapWatch, OneThatFallsSilentDoesNotHideBehindTheOthers) {
  GapWatch gaps = watch();
  see_from(gaps, "biceps_brachii", 1.01, 3.0);
  see_from(gaps, "shoulder", 1.01, 1.5);
  see_from(gaps, "shoulder", 2.4, 3.0);
  gaps.finish(3.0);
  EXPECT_NEAR(gaps.largest(), 0.9, 0.02);
  EXPECT_EQ(gaps.longest(), "shoulder");
}

TEST(GapWatch, BeginAndEndCount) {
  GapWatch late = watch();
  see_from(late, "biceps_brachii", 1.01, 3.0);
  see_from(late, "shoulder", 1.3, 3.0);
  EXPECT_NEAR(late.largest(), 0.3, 1e-9);
  GapWatch early = watch();
  see_from(early, "biceps_brachii", 1.01, 3.0);
  see_from(early, "shoulder", 1.01, 2.6);
  EXPECT_LT(early.largest(), 0.02);
  early.finish(3.0);
  EXPECT_NEAR(early.largest(), 0.4, 0.02);
  GapWatch never = watch();
  see_from(never, "biceps_brachii", 1.01, 3.0);
  never.finish(3.0);
  EXPECT_NEAR(never.largest(), 2.0, 1e-9);
}

TEST(GapWatch, WhatIsNotExpectedDoesNotMatter) {
  GapWatch gaps = watch();
  see_from(gaps, "biceps_brachii", 1.01, 2.0);
  see_from(gaps, "shoulder", 1.01, 2.0);
  gaps.see("somebody_else", 1.0);
  gaps.see("somebody_else", 2.0);
  EXPECT_LT(gaps.largest(), 0.02);
}

}  // namespace
}  // namespace anthrob
