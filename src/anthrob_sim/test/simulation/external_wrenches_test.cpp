// Pushing the links of a robot: statics and motion in closed form, duration, snapshots.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "allocations.h"
#include "simulation/moving_arm.h"

namespace anthrob {
namespace {

using testing_support::Random;
using testing_support::TemporaryRobot;

/// A ball joint, a hinge and a slide, one behind the other; `tool` is fixed to the last link.
TemporaryRobot chain() {
  return {R"(<robot name="chain"><link name="world"/>
    <joint name="ball" type="floating"><parent link="world"/><child link="upper"/>
      <origin xyz="0.1 0 1"/></joint>
    <link name="upper"><inertial><origin xyz="0.02 0.01 -0.2"/><mass value="2"/>
      <inertia ixx="2e-2" ixy="1e-3" ixz="0" iyy="2e-2" iyz="0" izz="1e-2"/></inertial></link>
    <joint name="hinge" type="continuous"><parent link="upper"/><child link="lower"/>
      <origin xyz="0 0.03 -0.4" rpy="0.3 0 0"/><axis xyz="0 1 0"/></joint>
    <link name="lower"><inertial><origin xyz="0 0.02 -0.1"/><mass value="1.5"/>
      <inertia ixx="1e-2" ixy="0" ixz="0" iyy="1e-2" iyz="0" izz="1e-2"/></inertial></link>
    <joint name="slide" type="prismatic"><parent link="lower"/><child link="rod"/>
      <origin xyz="0 0 -0.2"/><axis xyz="0 0 1"/>
      <limit lower="-10" upper="10" effort="1" velocity="1"/></joint>
    <link name="rod"><inertial><origin xyz="0.01 0 -0.1"/><mass value="0.5"/>
      <inertia ixx="5e-3" ixy="0" ixz="0" iyy="5e-3" iyz="0" izz="5e-3"/></inertial></link>
    <joint name="grip" type="fixed"><parent link="rod"/><child link="tool"/>
      <origin xyz="0 0.05 -0.3" rpy="0 1 0.5"/></joint><link name="tool"/>
    </robot>)",
          "robot: robot.urdf\ngravity: [0, 0, -9.81]\njoints:\n"
          "  ball: {type: ball, center: [0, 0, 0]}\n"
          "  slide: {stop: {stiffness: 2000, damping: 2}}\n"};
}

double speed_of(const Simulation& sim) {
  double speed = 0.0;
  for (const BodyState& body : sim.bodies()) speed += body.v_W.norm() + body.w_W.norm();
  return speed;
}

std::vector<double> posture_of_chain(Random& random) {
  const Quat ball(Eigen::AngleAxisd(random.uniform(-3.0, 3.0), random.direction()));
  return {ball.w(), ball.x(), ball.y(), ball.z(), random.uniform(-3, 3), random.uniform(-1, 1)};
}

/// Pushes of 35 N at the wrist, for a forearm of 0.1 kg, in any direction, again and again: the arm
/// is thrown where its bones would not let it go, and its eyelets come to lie inside its cylinders.
TEST(ExternalWrenches, ThrowTheArmAboutWithoutEnd) {
  Simulation sim(load_robot_model(testing_support::config("anthrob/model_II.yaml")));
  const int forearm = sim.model().skeleton->find_frame("forearm");
  const int half_a_second = static_cast<int>(0.5 / sim.step_length());
  Random random(1);
  double deepest = 0.0;
  for (int i = 0; i < 150; ++i) {
    Wrench push;
    push.frame = forearm, push.point = Vec3(0, -0.21, 0), push.force = 35.0 * random.direction();
    push.steps_left = half_a_second;
    sim.external_wrenches().push(push);
    for (int k = 0; k < 2 * half_a_second; ++k) {
      sim.step();
      for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
        for (const ObstacleState& obstacle : sim.muscle(static_cast<int>(m)).path().obstacles()) {
          deepest = std::max(deepest, obstacle.penetration);
          ASSERT_LT(obstacle.wrap_angle, 5.0 * M_PI) << sim.time();
        }
      }
    }
  }
  EXPECT_GT(deepest, 0.01);  // or it shows nothing
}

TEST(ExternalWrenches, ThatCarryEachWeightKeepTheRobotAtRest) {
  Simulation sim(chain().load());
  const SkeletonModel& skeleton = *sim.model().skeleton;
  Random random(3);
  for (int i = 0; i < 10; ++i) {
    sim.place(posture_of_chain(random), {});
    for (const char* link : {"upper", "lower", "rod"}) {
      const int frame = skeleton.find_frame(link);
      const BodyModel& body = skeleton.bodies[skeleton.frames[frame].body];
      sim.external_wrenches().push(
          {frame, body.com_L, Vec3(0, 0, 9.81 * body.mass), Vec3::Zero(), 1000});
    }
    sim.step(1000);
    EXPECT_LT(speed_of(sim), 1e-9) << i;
    sim.step(10);
    EXPECT_GT(speed_of(sim), 0.1) << i;  // they are over
  }
}

TEST(ExternalWrenches, MoveAFixedLinkAsTheForceAndItsMomentElsewhere) {
  // A force at a point of `tool`, and at the origin of `rod` with the moment that belongs to it.
  Simulation one(chain().load(1e-4)), other(chain().load(1e-4));
  const SkeletonModel& skeleton = *one.model().skeleton;
  const int tool = skeleton.find_frame("tool"), rod = skeleton.find_frame("rod");
  Random random(4);
  const std::vector<double> q = posture_of_chain(random);
  const Vec3 point(0.02, -0.03, 0.1), force(3.0, -2.0, 5.0), torque(0.1, 0.2, -0.3);
  one.place(q, {});
  other.place(q, {});
  for (int i = 0; i < 500; ++i) {
    one.external_wrenches().push({tool, point, force, torque, 1});
    const Vec3 lever = one.link_pose(tool) * point - one.link_pose(rod).p;
    other.external_wrenches().push({rod, Vec3::Zero(), force, torque + lever.cross(force), 1});
    one.step();
    other.step();
  }
  for (std::size_t i = 0; i < q.size(); ++i)
    EXPECT_NEAR(one.configuration()[i], other.configuration()[i], 1e-10);
  EXPECT_GT(posture_distance(skeleton, one.configuration(), q), 0.01);
}

TEST(ExternalWrenches, DoTheWorkThatTheRobotGains) {
  const double step = 1e-5;
  Simulation sim(chain().load(step));
  const int tool = sim.model().skeleton->find_frame("tool");
  Random random(5);
  sim.place(posture_of_chain(random), {});
  const Vec3 point(0.1, 0.0, -0.05), force(4.0, 7.0, -3.0);
  const double before = audit_energy(sim).kinetic + audit_energy(sim).potential;
  const Vec3 from = sim.link_pose(tool) * point;
  sim.external_wrenches().push({tool, point, force, Vec3::Zero(), 30000});
  sim.step(30000);
  const double work = force.dot(sim.link_pose(tool) * point - from);
  const double after = audit_energy(sim).kinetic + audit_energy(sim).potential;
  EXPECT_GT(std::abs(work), 0.5);
  EXPECT_NEAR(after - before, work, 2e-3 * std::abs(work));
}

TEST(ExternalWrenches, MustOvercomeDryFriction) {
  const TemporaryRobot robot(
      R"(<robot name="s"><link name="world"/>
    <joint name="slide" type="prismatic"><parent link="world"/><child link="rod"/>
      <axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
    <link name="rod"><inertial><mass value="2"/>
      <inertia ixx="1e-2" ixy="0" ixz="0" iyy="1e-2" iyz="0" izz="1e-2"/></inertial></link>
    </robot>)",
      "robot: robot.urdf\ngravity: [0, 0, -9.81]\njoints:\n"
      "  slide: {friction: {static: 8, kinetic: 8, viscous: 0, stribeck_velocity: 0.05}, stop: "
      "{stiffness: 2000, damping: "
      "2}}\n");
  for (const double excess : {-0.1, 0.1}) {
    Simulation sim(robot.load());
    const int rod = sim.model().skeleton->find_frame("rod");
    sim.external_wrenches().push({rod, Vec3::Zero(), Vec3(8.0 + excess, 0, 0), Vec3::Zero(), 500});
    sim.step(500);
    EXPECT_NEAR(sim.read_velocity(0), std::max(0.0, excess) / 2.0 * 0.5, 1e-6);
  }
}

TEST(ExternalWrenches, AtTheSamePointReplaceEachOther) {
  Simulation sim(chain().load());
  ExternalWrenches& wrenches = sim.external_wrenches();
  wrenches.push({1, Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3::Zero(), 10});
  wrenches.push({2, Vec3(0, 0, 1), Vec3(2, 0, 0), Vec3::Zero(), 10});
  wrenches.push({1, Vec3(0, 0, 1), Vec3(3, 0, 0), Vec3::Zero(), 20});
  ASSERT_EQ(wrenches.acting().size(), 2u);
  EXPECT_EQ(wrenches.acting()[1].force.x(), 3.0);
  wrenches.push({2, Vec3(0, 0, 1), Vec3(2, 0, 0), Vec3::Zero(), 0});
  ASSERT_EQ(wrenches.acting().size(), 1u);
  EXPECT_EQ(wrenches.acting()[0].steps_left, 20u);
}

TEST(ExternalWrenches, ArePartOfASnapshotAndTakeNoMemoryInAStep) {
  const auto model = testing_support::anthrob_model("II");
  Simulation original(model), fresh(model);
  const int hand = original.model().skeleton->find_frame("forearm");
  original.external_wrenches().push({hand, Vec3(0, 0, -0.1), Vec3(5, 0, 0), Vec3::Zero(), 150});
  original.external_wrenches().push({hand, Vec3::Zero(), Vec3(0, 5, 0), Vec3::Zero(), 80});
  original.step(50);
  const Snapshot snapshot = original.snapshot();
  fresh.restore(snapshot);
  const std::size_t before = testing_support::allocations();
  original.step(200);
  EXPECT_EQ(testing_support::allocations(), before);
  fresh.step(200);
  EXPECT_EQ(fresh.configuration(), original.configuration());
  EXPECT_TRUE(fresh.external_wrenches().acting().empty());
  original.restore(snapshot);
  original.external_wrenches().release();
  original.step(200);
  EXPECT_NE(fresh.configuration(), original.configuration());
}

TEST(ExternalWrenches, ThatAreNoneAreRefused) {
  Simulation sim(chain().load());
  ExternalWrenches& wrenches = sim.external_wrenches();
  const double nan = std::nan("");
  EXPECT_THROW(wrenches.push({-1}), BadInput);
  EXPECT_THROW(wrenches.push({99}), BadInput);
  EXPECT_THROW(wrenches.push({1, Vec3(nan, 0, 0)}), BadInput);
  EXPECT_THROW(wrenches.push({1, Vec3::Zero(), Vec3(0, 1e10, 0)}), BadInput);
  EXPECT_THROW(wrenches.push({1, Vec3::Zero(), Vec3::Zero(), Vec3(0, 0, nan)}), BadInput);
  EXPECT_TRUE(wrenches.acting().empty());
  for (std::size_t i = 0; i < ExternalWrenches::kMost; ++i)
    wrenches.push({1, Vec3(1e-6 * static_cast<double>(i), 0, 0)});
  EXPECT_THROW(wrenches.push({1, Vec3(1, 0, 0)}), BadInput);
  EXPECT_EQ(wrenches.acting().size(), ExternalWrenches::kMost);
  sim.reset();
  EXPECT_TRUE(wrenches.acting().empty());
}

}  // namespace
}  // namespace anthrob
