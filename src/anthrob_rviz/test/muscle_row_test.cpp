#include "muscle_row.h"

#include <gtest/gtest.h>

#include <cmath>

#include "readings.h"

namespace anthrob {
namespace {

MuscleRow row_at(double position, EcuState state = EcuState::kEnabled) {
  return {reading("biceps_brachii", position, state), ReferenceLimits()};
}

TEST(MuscleRow, PositionBeginsWhereTheMuscleIs) {
  MuscleRow row = row_at(0.5);
  row.hear(reading("biceps_brachii", 0.7), 1.0);
  row.press();
  EXPECT_EQ(row.target(), 0.7);
  row.hear(reading("biceps_brachii", 0.9), 2.0);  // it moves on, and the target does not
  const Reference sent = row.take(2.0);
  EXPECT_EQ(sent.muscle, "biceps_brachii");
  EXPECT_EQ(sent.mode, ControlMode::kPosition);
  EXPECT_EQ(sent.value, 0.7);
}

TEST(MuscleRow, APositionBeyondTheLimitsWidensThem) {
  MuscleRow row = row_at(14.0);
  row.press();
  EXPECT_EQ(row.target(), 14.0);
  EXPECT_EQ(row.range().high, 14.0);
}

TEST(MuscleRow, ForceBeginsAtTheForceAndVoltageAtZero) {
  MuscleRow row = row_at(0.5);
  row.set_mode(ControlMode::kForce);
  EXPECT_EQ(row.target(), 5.0);
  row.set_mode(ControlMode::kVoltage);
  EXPECT_EQ(row.target(), 0.0);
}

TEST(MuscleRow, ATargetThatIsSetWhileNothingIsSentIsNoLaterJump) {
  MuscleRow row = row_at(0.5);
  row.set_target(3.0);
  row.press();
  EXPECT_EQ(row.target(), 0.5);
  row.set_target(3.0);
  EXPECT_EQ(row.target(), 3.0);
  row.set_target(99.0);
  EXPECT_EQ(row.target(), 10.0);
  row.set_target(std::nan(""));
  EXPECT_EQ(row.target(), 10.0);
}

TEST(MuscleRow, AnotherModeEndsAHold) {
  MuscleRow row = row_at(0.5);
  row.hold(true);
  row.set_mode(ControlMode::kForce);
  EXPECT_FALSE(row.active());
}

TEST(MuscleRow, WhereNothingIsMeasuredNothingBegins) {
  MuscleReading unknown = reading("biceps_brachii", std::nan(""));
  unknown.force = std::nan("");
  MuscleRow row(unknown, ReferenceLimits());
  row.hold(true);
  EXPECT_FALSE(row.active());
  EXPECT_EQ(row.remark(0.0).value(), "no measured position to begin with");
  row.set_mode(ControlMode::kForce);
  row.press();
  EXPECT_FALSE(row.active());
  EXPECT_EQ(row.remark(0.0).value(), "no force sensor");
  row.set_mode(ControlMode::kVoltage);
  row.press();
  EXPECT_TRUE(row.active());
}

TEST(MuscleRow, AStopEndsItsHold) {
  MuscleRow row = row_at(0.5, EcuState::kIdle);
  row.hold(true);
  row.take(0.0);
  row.hear(reading("biceps_brachii", 0.5, EcuState::kEnabled), 0.1);
  row.hear(reading("biceps_brachii", 0.5, EcuState::kStopping), 5.0);
  EXPECT_FALSE(row.held());
  EXPECT_EQ(row.remark(5.0).value(), "the robot stopped this motor");
  row.hear(reading("biceps_brachii", 0.6, EcuState::kEnabled), 6.0);
  EXPECT_FALSE(row.active());
}

/// A motor whose time-out ran out in the very moment of the first command.
TEST(MuscleRow, ATimeOutBeforeTheFirstCommandDoesNot) {
  MuscleRow row = row_at(0.5);
  row.press();
  row.take(0.0);
  row.hear(reading("biceps_brachii", 0.5, EcuState::kEnabled), 0.01);
  row.hear(reading("biceps_brachii", 0.5, EcuState::kStopping), 0.02);
  row.hear(reading("biceps_brachii", 0.5, EcuState::kEnabled), 0.04);
  row.hear(reading("biceps_brachii", 0.5, EcuState::kEnabled), 1.0);
  EXPECT_TRUE(row.active());
}

TEST(MuscleRow, AFaultEndsItsHoldAndPreventsAnother) {
  MuscleRow row = row_at(0.5);
  row.hold(true);
  row.hear(reading("biceps_brachii", 0.5, EcuState::kFault), 0.1);
  EXPECT_FALSE(row.active());
  row.hold(true);
  EXPECT_FALSE(row.active());
  EXPECT_EQ(row.remark(1.0).value(), "fault");
}

TEST(MuscleRow, SaysThatItsCommandsAreNotFollowed) {
  MuscleRow row = row_at(0.5, EcuState::kIdle);
  row.hold(true);
  row.take(0.0);
  row.hear(reading("biceps_brachii", 0.5, EcuState::kIdle), 0.5);
  EXPECT_FALSE(row.remark(0.5).has_value());
  EXPECT_EQ(row.remark(1.0).value(), "not enabled: press Enable");
  MuscleReading follows = reading("biceps_brachii", 0.5);
  follows.reference = 2.0;
  row.hear(follows, 1.0);
  EXPECT_EQ(row.remark(1.0).value(), "not followed: refused, or another node commands it");
  follows.reference = 0.5;
  row.hear(follows, 1.1);
  EXPECT_FALSE(row.remark(1.1).has_value());
}

TEST(MuscleRow, Lights) {
  EXPECT_EQ(row_at(0.0).light(true), Light::kEnabled);
  EXPECT_EQ(row_at(0.0).light(false), Light::kStale);
  EXPECT_EQ(row_at(0.0, EcuState::kIdle).light(true), Light::kDisabled);
  EXPECT_EQ(row_at(0.0, EcuState::kFault).light(true), Light::kFault);
}

}  // namespace
}  // namespace anthrob
