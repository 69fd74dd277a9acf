#include "muscle_board.h"

#include <gtest/gtest.h>

#include "readings.h"

namespace anthrob {
namespace {

MuscleReadings two_muscles(double position = 1.0) {
  return {reading("flexor", position), reading("extensor", -position)};
}

/// Seen, and of a robot that is heard.
MuscleBoard board_at(double now) {
  MuscleBoard board;
  board.show(true);
  EXPECT_TRUE(board.hear(two_muscles(), now));
  return board;
}

TEST(MuscleBoard, SendsNothingByItself) {
  MuscleBoard board = board_at(0.0);
  EXPECT_TRUE(board.take(0.1).empty());
  EXPECT_FALSE(board.stopped().has_value());
}

TEST(MuscleBoard, SendsWhatIsPressedOrHeldInOneCommand) {
  MuscleBoard board = board_at(0.0);
  board.rows()[1].press();
  ASSERT_EQ(board.take(0.0).size(), 1U);
  board.rows()[0].hold(true);
  const auto references = board.take(0.06);
  ASSERT_EQ(references.size(), 2U);
  EXPECT_EQ(references[0].muscle, "flexor");
  EXPECT_EQ(references[0].value, 1.0);
  board.rows()[1].release();
  EXPECT_EQ(board.take(0.12).size(), 1U);
  board.rows()[0].hold(false);
  EXPECT_TRUE(board.take(0.18).empty());
}

TEST(MuscleBoard, ASilentRobotEndsAllHolds) {
  MuscleBoard board = board_at(0.0);
  board.hold_all(true);
  EXPECT_FALSE(board.take(0.5).empty());
  EXPECT_TRUE(board.take(0.51).empty());
  EXPECT_EQ(board.stopped().value(), "the robot's states are older than 0.5 s");
  EXPECT_FALSE(board.any_active());
  board.hear(two_muscles(), 1.0);  // it is there again, and nothing goes on by itself
  EXPECT_TRUE(board.take(1.0).empty());
  board.hold_all(true);
  EXPECT_FALSE(board.take(1.1).empty());
  EXPECT_FALSE(board.stopped().has_value());
}

TEST(MuscleBoard, AHiddenPanelEndsAllHolds) {
  MuscleBoard board = board_at(0.0);
  board.rows()[0].press();
  board.show(false);
  EXPECT_TRUE(board.take(0.0).empty());
  EXPECT_EQ(board.stopped().value(), "the panel was hidden");
  board.show(true);
  EXPECT_TRUE(board.take(0.1).empty());
}

TEST(MuscleBoard, HoldHereHoldsTheMeasuredPositions) {
  MuscleBoard board = board_at(0.0);
  board.rows()[0].set_mode(ControlMode::kForce);
  board.rows()[0].hold(true);
  board.hear(two_muscles(2.0), 0.1);
  board.hold_here();
  const auto references = board.take(0.1);
  ASSERT_EQ(references.size(), 2U);
  EXPECT_EQ(references[0].mode, ControlMode::kPosition);
  EXPECT_EQ(references[0].value, 2.0);
  EXPECT_EQ(references[1].value, -2.0);
  EXPECT_TRUE(board.all_held());
}

TEST(MuscleBoard, RelaxAllAsksForNoVolts) {
  MuscleBoard board = board_at(0.0);
  board.hold_here();
  board.relax_all();
  for (const Reference& reference : board.take(0.0)) {
    EXPECT_EQ(reference.mode, ControlMode::kVoltage);
    EXPECT_EQ(reference.value, 0.0);
  }
  EXPECT_TRUE(board.all_held());
}

TEST(MuscleBoard, TightenAllAsksForThePretensionAndLoosensNone) {
  MuscleBoard board = board_at(0.0);
  auto muscles = two_muscles(1.0);
  muscles[0].force = 30.0, muscles[1].force = 0.5;
  board.hear(muscles, 0.0);
  board.tighten_all();
  const auto references = board.take(0.0);
  ASSERT_EQ(references.size(), 2U);
  EXPECT_EQ(references[0].mode, ControlMode::kForce);
  EXPECT_EQ(references[0].value, 30.0);
  EXPECT_EQ(references[1].value, 5.0);
}

TEST(MuscleBoard, OtherMusclesAreOtherRows) {
  MuscleBoard board = board_at(0.0);
  board.hold_all(true);
  EXPECT_FALSE(board.hear(two_muscles(3.0), 0.1));
  EXPECT_TRUE(board.hear({reading("only_one", 0.0)}, 0.2));
  EXPECT_EQ(board.rows().size(), 1U);
  EXPECT_TRUE(board.take(0.2).empty());
}

TEST(MuscleBoard, WithoutMusclesNothingIsHeld) {
  MuscleBoard board;
  board.show(true);
  board.hold_here();
  EXPECT_FALSE(board.all_held());
  EXPECT_TRUE(board.take(0.0).empty());
}

}  // namespace
}  // namespace anthrob
