// Postures that somebody asks for: the limits of joints and commands, and what a stop gives.
#include "anthrob_sim/placement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_sim/simulation.h"
#include "support.h"

namespace anthrob {
namespace {

using testing_support::config;

template <typename Set>
std::string refusal(Set set) {
  try {
    set();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

Quat turn_by(double angle) {
  return Quat(Eigen::AngleAxisd(angle, Vec3(1, -2, 2).normalized()));
}

TEST(Placement, StartsFromRestOrFromASimulation) {
  const auto model = load_robot_model(config("anthrob/model_I.yaml"));
  const Placement rest(*model);
  EXPECT_EQ(rest.q(), (std::vector<double>{1, 0, 0, 0, 0}));
  EXPECT_EQ(rest.positions(), std::vector<double>(11, 0.0));
  Simulation sim(model);
  const Quat turn = turn_by(0.4);
  const std::vector<double> q = {turn.w(), turn.x(), turn.y(), turn.z(), 1.2};
  sim.place(q, std::vector<double>(11, 0.5));
  Placement here(sim);
  here.set_muscle("brachialis", 2.0);
  EXPECT_EQ(here.positions()[model->find_muscle("brachialis")], 2.0);
  EXPECT_EQ(here.positions()[0], 0.5);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(here.q()[i], q[i], 1e-12);
}

TEST(Placement, HingesStayWithinTheirStopAndWhatItGives) {
  const auto model = load_robot_model(config("anthrob/model_I.yaml"));
  const JointModel& elbow = model->skeleton->joints[model->skeleton->find_joint("elbow")];
  Placement placement(*model);
  for (const double angle : {-0.0003, 0.0, 1.0, elbow.stop.upper, elbow.stop.upper + 0.003}) {
    placement.set_joint("elbow", angle);
    EXPECT_EQ(placement.q()[4], angle);
  }
  for (const double angle : {elbow.stop.lower - 0.06, elbow.stop.upper + 0.06, 9.0}) {
    const std::string text = refusal([&] { placement.set_joint("elbow", angle); });
    EXPECT_NE(text.find("joint 'elbow'"), std::string::npos) << text;
    EXPECT_NE(text.find("limits"), std::string::npos) << text;
  }
  EXPECT_NE(refusal([&] { placement.set_joint("elbow", std::nan("")); }), "");
  EXPECT_EQ(refusal([&] { placement.set_joint("shoulder", 0.0); }),
            "joint 'shoulder' is a ball joint: give its orientation (ball_joint_name, "
            "ball_joint_orientation)");
  EXPECT_EQ(refusal([&] { placement.set_joint("knee", 0.0); }),
            "joint 'knee': no hinge or prismatic joint of that name");
}

TEST(Placement, ANameThatComesTwiceIsRefused) {
  EXPECT_EQ(refusal([] {
              refuse_repeated("joint", {"elbow", "shoulder", "elbow"});
            }),
            "joint 'elbow': named twice");
  EXPECT_EQ(refusal([] { refuse_repeated("joint", {"elbow", "shoulder"}); }), "");
  EXPECT_EQ(refusal([] { refuse_repeated("joint", {}); }), "");
}

TEST(Placement, JointsWithoutAStopGoAsFarAsNumbersMakeSense) {
  const testing_support::TemporaryRobot wheel(
      R"(<robot name="wheel"><link name="base"/>
      <joint name="axle" type="continuous"><parent link="base"/><child link="disc"/><axis xyz="0 1 0"/></joint>
      <link name="disc"><inertial><mass value="1"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link></robot>)",
      "robot: robot.urdf\ngravity: [0, 0, -9.81]\n");
  const auto model = wheel.load();
  Placement placement(*model);
  placement.set_joint("axle", -1e6);
  for (const double bad : {1e9, -1e9, HUGE_VAL, std::nan("")}) {
    EXPECT_NE(refusal([&] { placement.set_joint("axle", bad); }), "");
  }
  Simulation(model).place(placement.q(), placement.positions());
}

TEST(Placement, BallJointsStayWithinTheirStop) {
  const auto model = load_robot_model(config("torso_100/model_II.yaml"));
  Placement placement(*model);
  placement.set_ball_joint("spine_2", turn_by(0.69));
  placement.set_ball_joint("spine_2", turn_by(0.72));
  for (const double angle : {0.76, 3.0}) {
    const std::string text = refusal([&] { placement.set_ball_joint("spine_2", turn_by(angle)); });
    EXPECT_NE(text.find("limits, 0 to 0.7"), std::string::npos) << text;
  }
  // The same turn, written the other way round.
  const Quat small = turn_by(0.2);
  placement.set_ball_joint("spine_2", Quat(-small.w(), -small.x(), -small.y(), -small.z()));
  EXPECT_NE(refusal([&] { placement.set_ball_joint("spine_2", Quat(0, 0, 0, 0)); }), "");
  EXPECT_NE(refusal([&] { placement.set_ball_joint("spine_2", Quat(std::nan(""), 0, 0, 0)); }), "");
}

TEST(Placement, MusclesStayWithinTheLimitsOfCommands) {
  const auto model = load_robot_model(config("anthrob/model_I.yaml"));
  const MuscleModel& muscle = model->muscles[model->find_muscle("brachialis")];
  Placement placement(*model);
  placement.set_muscle("brachialis", muscle.limits.position);
  placement.set_muscle("brachialis", -muscle.limits.position);
  for (const double position : {muscle.limits.position + 0.1, -1e6, 1e6}) {
    const std::string text = refusal([&] { placement.set_muscle("brachialis", position); });
    EXPECT_NE(text.find("limits"), std::string::npos) << text;
  }
  EXPECT_NE(refusal([&] { placement.set_muscle("brachialis", std::nan("")); }), "");
  EXPECT_NE(refusal([&] { placement.set_muscle("nobody", 0.0); }), "");
}

TEST(Placement, ALigamentHasNoOtherPositionThanZero) {
  const auto model = load_robot_model(config("two_muscle_rig/model_hill.yaml"));
  Placement placement(*model);
  placement.set_muscle("capsule", 0.0);
  const std::string text = refusal([&] { placement.set_muscle("capsule", 0.5); });
  EXPECT_NE(text.find("muscle 'capsule': 0.5: expected 0"), std::string::npos) << text;
}

TEST(Placement, AHillMuscleHasAShortestLength) {
  const auto model = load_robot_model(config("two_muscle_rig/model_hill.yaml"));
  Placement placement(*model);
  placement.set_muscle("flexor", 0.8);
  const std::string text = refusal([&] { placement.set_muscle("flexor", 0.81); });
  EXPECT_NE(text.find("to 0.8"), std::string::npos) << text;
}

}  // namespace
}  // namespace anthrob
