#include "anthrob_control/robot_state.h"

#include <gtest/gtest.h>

#include <cmath>

namespace anthrob {
namespace {

class RobotStateTest : public ::testing::Test {
 protected:
  void see_all(double stamp) {
    for (const MuscleModel& muscle : model->muscles)
      state.see_muscle(muscle.name, {0.1, 0.0, 0.0, 5.0}, true, stamp);
    state.see_joint("elbow", 0.5, 0.0, stamp);
    state.see_ball_joint("shoulder", Quat(1, 0, 0, 0), Vec3::Zero(), stamp);
  }

  std::shared_ptr<const RobotModel> model =
      load_robot_model(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml");
  RobotState state{model};
};

TEST_F(RobotStateTest, NamesWhatIsMissingOrOld) {
  EXPECT_EQ(state.complaint(0.0, 0.1), "joint shoulder: not measured yet");
  see_all(1.0);
  EXPECT_EQ(state.complaint(1.05, 0.1), std::nullopt);
  EXPECT_EQ(state.complaint(1.2, 0.1), "joint shoulder: the last measurement is 0.200 s old");
  state.see_ball_joint("shoulder", Quat(1, 0, 0, 0), Vec3::Zero(), 1.2);
  EXPECT_EQ(state.complaint(1.2, 0.1), "joint elbow: the last measurement is 0.200 s old");
  EXPECT_FALSE(state.complete_since(1.2));
  see_all(1.2);
  EXPECT_TRUE(state.complete_since(1.2));
  state.clear();
  EXPECT_TRUE(state.complaint(1.2, 0.1));
}

TEST_F(RobotStateTest, WhatIsStampedAheadOfTimeIsNotFresh) {
  see_all(1.0);
  EXPECT_EQ(state.complaint(0.9, 0.1), std::nullopt);  // clocks are never quite the same
  EXPECT_EQ(state.complaint(0.0, 0.1),
            "joint shoulder: the last measurement is 1.000 s in the future: clocks differ, or time "
            "was set back");
}

TEST_F(RobotStateTest, AClockThatIsAheadMakesNothingYoung) {
  state.receive_at(0.6);
  see_all(1.0);  // by the clock of the sensors
  EXPECT_EQ(state.complaint(0.65, 0.1), std::nullopt);
  EXPECT_EQ(state.complaint(0.8, 0.1), "joint shoulder: the last measurement is 0.200 s old");
  // One that is late on its way is as old as it says.
  state.receive_at(2.0);
  see_all(1.8);
  EXPECT_EQ(state.complaint(2.0, 0.1), "joint shoulder: the last measurement is 0.200 s old");
}

TEST_F(RobotStateTest, AJointThatJumpsIsNotBelieved) {
  see_all(1.0);
  state.see_joint("elbow", 1.7, 0.0, 1.01);
  EXPECT_EQ(state.complaint(1.01, 0.1),
            "joint elbow: jumped by 1.2 rad in 0.01 s, faster than a joint moves: a loose encoder, "
            "or two nodes that publish it?");
  EXPECT_EQ(state.measurement().q[4], 0.5);
  EXPECT_TRUE(state.complete_since(1.0)) << "it was measured";
  state.see_joint("elbow", 0.51, 0.0, 1.02);
  EXPECT_EQ(state.complaint(1.02, 0.1), std::nullopt) << "it was a single error";
  EXPECT_EQ(state.measurement().q[4], 0.51);
  EXPECT_FALSE(state.take_jump());
}

TEST_F(RobotStateTest, OfTwoThatAlternateOnlyOneIsEverBelieved) {
  see_all(1.0);
  for (int i = 1; i < 200; ++i) {
    const double t = 1.0 + 0.01 * i;
    see_all(t - 0.005);
    state.see_joint("elbow", 0.0, 0.0, t);
    EXPECT_TRUE(state.complaint(t, 0.1));
    EXPECT_EQ(state.measurement().q[4], 0.5);
  }
}

TEST_F(RobotStateTest, WhereABallJointStaysForAFifthOfASecondItIs) {
  see_all(1.0);
  const Quat turned(Eigen::AngleAxisd(2.0, Vec3::UnitX()));
  for (int i = 1; i <= 20; ++i) {
    state.see_ball_joint("shoulder", turned, Vec3::Zero(), 1.0 + 0.01 * i);
    EXPECT_FALSE(state.take_jump()) << i;
  }
  EXPECT_EQ(
      state.complaint(1.2, 0.5).value_or(""),
      "joint shoulder: jumped by 2 rad in 0.01 s, faster than a joint moves: a loose encoder, "
      "or two nodes that publish it?");
  state.see_ball_joint("shoulder", turned, Vec3::Zero(), 1.22);
  EXPECT_EQ(state.complaint(1.22, 0.5), std::nullopt);
  EXPECT_NEAR(state.measurement().q[0], turned.w(), 1e-12);
  EXPECT_TRUE(state.take_jump());
  EXPECT_FALSE(state.take_jump()) << "told once";
}

TEST_F(RobotStateTest, AFastJointIsBelieved) {
  see_all(1.0);
  for (int i = 1; i < 100; ++i) {
    const double noise = i % 2 == 0 ? 0.02 : -0.02;
    state.see_joint("elbow", 0.5 + 0.2 * i + noise, 20.0, 1.0 + 0.01 * i);
    EXPECT_EQ(state.complaint(1.0 + 0.01 * i, 2.0), std::nullopt) << i;
  }
}

TEST_F(RobotStateTest, WhatIsNoMeasurementDoesNotCount) {
  see_all(1.0);
  state.see_joint("elbow", NAN, 0.0, 2.0);
  state.see_ball_joint("shoulder", Quat(0, 0, 0, 0), Vec3::Zero(), 2.0);
  state.see_ball_joint("elbow", Quat(1, 0, 0, 0), Vec3::Zero(), 2.0);
  state.see_joint("shoulder", 1.0, 0.0, 2.0);
  state.see_joint("wrist", 1.0, 0.0, 2.0);
  state.see_muscle("brachialis", {0.0, INFINITY, 0.0, 0.0}, true, 2.0);
  EXPECT_FALSE(state.complete_since(1.5));
  EXPECT_EQ(state.measurement().q, (std::vector<double>{1, 0, 0, 0, 0.5}));
}

TEST(RobotStateOfALigament, NeedsNoMeasurementOfWhatTakesNoCommand) {
  const auto model =
      load_robot_model(std::string(ANTHROB_CONFIG_DIR) + "/two_muscle_rig/model_hill.yaml");
  RobotState state(model);
  state.see_joint("hinge", 0.5, 0.0, 1.0);
  state.see_muscle("flexor", {0.1, 0.0, 0.0, 5.0}, true, 1.0);
  EXPECT_EQ(state.complaint(1.0, 0.1), "muscle extensor: not measured yet");
  EXPECT_FALSE(state.complete_since(1.0));
  state.see_muscle("extensor", {0.1, 0.0, 0.0, 5.0}, true, 1.0);
  EXPECT_EQ(state.complaint(1.0, 0.1), std::nullopt);  // nobody has measured the capsule
  EXPECT_TRUE(state.complete_since(1.0));
  const auto capsule = static_cast<std::size_t>(model->find_muscle("capsule"));
  EXPECT_TRUE(std::isnan(state.measurement().muscles[capsule].force));
  state.see_muscle("capsule", {0.0, 0.0, 0.0, 3.0}, false, 1.0);
  EXPECT_EQ(state.measurement().muscles[capsule].force, 3.0);
}

TEST_F(RobotStateTest, SeesWhoFollowsSomethingElse) {
  see_all(1.0);
  EXPECT_EQ(state.muscle_not_in(ecu::Mode::kPosition), std::nullopt);  // nobody told
  for (const MuscleModel& muscle : model->muscles)
    state.see_mode(muscle.name, ecu::Mode::kPosition);
  EXPECT_EQ(state.muscle_not_in(ecu::Mode::kPosition), std::nullopt);
  state.see_mode("brachialis", ecu::Mode::kVoltage);
  EXPECT_EQ(state.muscle_not_in(ecu::Mode::kPosition), "brachialis");
  state.see_muscle("brachialis", {0.1, 0.0, 0.0, 5.0}, false, 1.1);
  EXPECT_EQ(state.muscle_not_in(ecu::Mode::kPosition), std::nullopt);  // disabled_muscle() tells
  state.see_mode("nobody", ecu::Mode::kVoltage);
}

TEST_F(RobotStateTest, RemembersAStopUntilItIsAskedFor) {
  see_all(1.0);
  EXPECT_EQ(state.take_disabled(), std::nullopt);
  // Stopped and enabled again between two looks.
  state.see_muscle("brachialis", {0.1, 0.0, 0.0, 5.0}, false, 1.1);
  state.see_muscle("brachialis", {0.1, 0.0, 0.0, 5.0}, true, 1.2);
  EXPECT_EQ(state.disabled_muscle(), std::nullopt);
  EXPECT_EQ(state.take_disabled(), "brachialis");
  EXPECT_EQ(state.take_disabled(), std::nullopt);
  // A unit that did not answer once may well follow; one that was lost says so when it is back.
  state.see_muscle("brachialis", {NAN, NAN, NAN, NAN}, false, 1.3);
  EXPECT_EQ(state.take_disabled(), std::nullopt);
  state.see_muscle("brachialis", {0.1, 0.0, 0.0, 5.0}, false, 1.4);
  EXPECT_EQ(state.take_disabled(), "brachialis");
}

TEST_F(RobotStateTest, AMuscleWithoutForceSensorIsMeasured) {
  see_all(1.0);
  EXPECT_EQ(state.muscle_without_force(), std::nullopt);
  state.see_muscle("brachialis", {0.3, 0.0, 0.0, NAN}, true, 2.0);
  EXPECT_EQ(state.measurement()
                .muscles[static_cast<std::size_t>(model->find_muscle("brachialis"))]
                .position,
            0.3);
  EXPECT_EQ(state.muscle_without_force(), "brachialis");
  for (const ecu::Measurement& m :
       {ecu::Measurement{NAN, 0, 0, 5}, ecu::Measurement{0, NAN, 0, 5},
        ecu::Measurement{0, 0, NAN, 5}, ecu::Measurement{0, 0, 0, INFINITY}}) {
    state.see_muscle("brachialis", m, true, 3.0);
    EXPECT_TRUE(std::isnan(state.measurement()
                               .muscles[static_cast<std::size_t>(model->find_muscle("brachialis"))]
                               .force));
  }
}

TEST_F(RobotStateTest, KnowsWhetherMotorsFollow) {
  see_all(1.0);
  EXPECT_EQ(state.disabled_muscle(), std::nullopt);
  state.see_muscle("teres_major", {}, false, 1.0);
  EXPECT_EQ(state.disabled_muscle(), "teres_major");
}

}  // namespace
}  // namespace anthrob
