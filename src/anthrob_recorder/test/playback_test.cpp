#include "playback.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

using Step = Playback::Step;

TEST(Playback, GoesThroughARecordingAtItsRate) {
  Playback playback(3.0, {2.0, false});
  EXPECT_EQ(playback.advance(0.1), Step::kJumped);
  EXPECT_EQ(playback.position(), 0.0);
  EXPECT_EQ(playback.advance(0.5), Step::kOn);
  EXPECT_DOUBLE_EQ(playback.position(), 1.0);
  playback.set_rate(0.5);
  EXPECT_EQ(playback.advance(1.0), Step::kOn);
  EXPECT_DOUBLE_EQ(playback.position(), 1.5);
  EXPECT_EQ(playback.advance(100.0), Step::kOn);  // all that is left is shown
  EXPECT_EQ(playback.position(), 3.0);
  EXPECT_EQ(playback.advance(0.1), Step::kEnded);
}

TEST(Playback, BeginsAgain) {
  Playback playback(1.0, {1.0, true});
  playback.advance(0.0);
  playback.advance(5.0);
  EXPECT_EQ(playback.advance(0.1), Step::kJumped);
  EXPECT_EQ(playback.position(), 0.0);
}

TEST(Playback, GoesToAnyPlaceWhilePaused) {
  Playback playback(2.0, {1.0, false});
  playback.advance(0.0);
  playback.pause(true);
  EXPECT_EQ(playback.advance(1.0), Step::kOn);
  EXPECT_EQ(playback.position(), 0.0);
  playback.seek(1.5);
  EXPECT_EQ(playback.advance(0.1), Step::kJumped);
  EXPECT_EQ(playback.position(), 1.5);
  for (const double outside : {-1.0, 9.0}) {
    playback.seek(outside);
    playback.advance(0.1);
    EXPECT_EQ(playback.position(), outside < 0.0 ? 0.0 : 2.0);
  }
  EXPECT_EQ(playback.advance(0.1), Step::kOn);  // the end, too, can be looked at
}

}  // namespace
}  // namespace anthrob
