#include "twin/twins.h"

#include <gtest/gtest.h>

#include <cmath>

#include "twin/gap_watch.h"
#include "twin/moving_robot.h"

namespace anthrob {
namespace twin {
namespace {

MovingRobot robot_with(const LoadOptions& difference) {
  return {noisy_robot(rig_file(), difference), *noisy_robot(rig_file())};
}

/// What the diagnostics say after a while of motion.
std::vector<GapWatch::Warning> warnings_of(const MovingRobot& robot) {
  GapWatch watch(TwinOptions{}.warn);
  watch.see(robot.twins.channels(), robot.twins.report());
  return watch.warnings();
}

void expect_part(const LoadOptions& difference, Part part, const std::string& owner) {
  MovingRobot robot = robot_with(difference);
  robot.run(20.0);
  const auto warnings = warnings_of(robot);
  ASSERT_FALSE(warnings.empty());
  bool named = false;
  for (const auto& warning : warnings) {
    EXPECT_EQ(warning.finding.part, part) << warning.text();
    named = named || warning.finding.owner == owner;
  }
  EXPECT_TRUE(named) << owner;
}

TEST(Twins, RightModelIsOneFloor) {
  MovingRobot robot = robot_with({});
  robot.run(20.0);
  for (const Feed feed : kFeeds) {
    EXPECT_TRUE(robot.twins.status(feed).counts);
    EXPECT_LT(robot.largest_gap(feed), 2.0) << index_of(feed);
  }
  EXPECT_GT(robot.gap("flexor/force", Feed::kPostures), 0.7);
  EXPECT_GT(robot.gap("hinge/position", Feed::kPositions), 0.7);
  EXPECT_TRUE(warnings_of(robot).empty());
  EXPECT_TRUE(std::isnan(robot.gap("flexor/position", Feed::kPositions)));
  EXPECT_TRUE(std::isnan(robot.gap("hinge/position", Feed::kPostures)));
}

TEST(Twins, AnthrobInMotionIsOneFloor) {
  const std::string file = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_II_noisy.yaml";
  const auto robot_model = load_robot_model(file);
  MovingRobot robot(robot_model, *robot_model);
  robot.run(14.0, [](MovingRobot& r) {
    r.twins.hear(joint_sample(r.sim, Topic::kBallJoints, r.stamp()), Topic::kBallJoints);
    r.hear();
  });
  for (const Feed feed : kFeeds) EXPECT_LT(robot.largest_gap(feed), 2.5) << index_of(feed);
  EXPECT_TRUE(warnings_of(robot).empty());
}

TEST(Twins, Spring) {
  LoadOptions other;
  other.overrides["springs.rubber.modulus"] = 0.7e6;
  expect_part(other, Part::kSpring, "flexor");
}

TEST(Twins, Tendon) {
  LoadOptions other;
  other.effects = {{"tendon_elasticity", "extensor", {{"compliance", 0.0005}}}};
  expect_part(other, Part::kSpring, "extensor");
}

TEST(Twins, Joint) {
  LoadOptions other;
  other.effects = {{"joint_viscous", "hinge", {{"damping", 0.1}}}};
  expect_part(other, Part::kJoint, "hinge");
}

TEST(Twins, Motor) {
  LoadOptions other;
  other.overrides["actuators.motor.motor.torque_constant"] = 0.0085;
  expect_part(other, Part::kMotor, "flexor");
}

TEST(Twins, Gear) {
  LoadOptions other;
  other.effects = {{"gear_efficiency", "extensor", {{"loss", 0.3}}}};
  expect_part(other, Part::kMotor, "extensor");
}

TEST(Twins, Controller) {
  LoadOptions other;
  other.overrides["controllers.pd.position.proportional"] = 4.5;
  expect_part(other, Part::kController, "flexor");
}

TEST(Twins, ControllerThatIsLate) {
  LoadOptions other;
  other.effects = {{"command_latency", "flexor", {{"delay", 0.03}}}};
  expect_part(other, Part::kController, "flexor");
}

TEST(Twins, SameSamplesSameBits) {
  MovingRobot first = robot_with({}), second = robot_with({});
  first.run(5.0);
  // Heard all at once, and simulated afterwards.
  second.run(5.0, [](MovingRobot& r) {
    r.twins.hear(muscle_sample(r.sim, r.stamp()));
    r.twins.hear(joint_sample(r.sim, Topic::kJoints, r.stamp()), Topic::kJoints);
    if (r.stamp() == nanoseconds(0.005)) r.advance();
  });
  second.advance();
  ASSERT_EQ(first.blocks, 4);
  ASSERT_EQ(second.blocks, first.blocks);
  for (const Feed feed : kFeeds) {
    EXPECT_EQ(first.twins.sim(feed).snapshot().state, second.twins.sim(feed).snapshot().state);
  }
  for (std::size_t i = 0; i < first.twins.report().rms.size(); ++i) {
    const double a = first.twins.report().rms[i], b = second.twins.report().rms[i];
    EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
  }
}

TEST(Twins, LostRepeatedAndOutOfOrder) {
  MovingRobot robot = robot_with({});
  std::vector<MuscleSample> kept;
  int count = 0;
  robot.run(20.0, [&](MovingRobot& r) {
    const MuscleSample muscles = muscle_sample(r.sim, r.stamp());
    const JointSample joints = joint_sample(r.sim, Topic::kJoints, r.stamp());
    r.twins.hear(joints, Topic::kJoints);
    if (++count % 7 == 0) return;  // lost
    if (count % 5 == 0) {
      kept.push_back(muscles);  // comes after the next one
      return;
    }
    r.twins.hear(muscles);
    r.advance();
    if (count % 3 == 0) r.twins.hear(muscles);
    for (const MuscleSample& late : kept) r.twins.hear(late);
    kept.clear();
  });
  const Arrivals& arrivals = robot.twins.measurements().arrivals(Topic::kMuscles);
  EXPECT_GT(arrivals.repeated, 100);
  EXPECT_GT(arrivals.late, 100);
  for (const Feed feed : kFeeds) {
    EXPECT_EQ(robot.twins.status(feed).starts, 1);
    EXPECT_LT(robot.largest_gap(feed), 3.0) << index_of(feed);
  }
}

TEST(Twins, PauseIsNoTime) {
  // While the simulator is paused, nothing is measured, or the same again and again.
  MovingRobot robot = robot_with({});
  robot.run(8.0);
  for (int i = 0; i < 1000; ++i) robot.hear();
  const auto paused = robot.twins.time();
  robot.run(8.0);
  ASSERT_TRUE(paused);
  EXPECT_NEAR(seconds(*paused), 8.0, 0.02);
  EXPECT_EQ(robot.twins.status(Feed::kCommands).starts, 1);
  for (const Feed feed : kFeeds) EXPECT_LT(robot.largest_gap(feed), 2.0);
}

TEST(Twins, ResetStartsAnew) {
  MovingRobot robot = robot_with({});
  robot.run(8.0);
  robot.sim.skip(20);
  robot.sim.reset();
  robot.stopped = true;
  robot.run(0.1);
  for (const Feed feed : kFeeds) {
    EXPECT_EQ(robot.twins.status(feed).starts, 2);
    EXPECT_TRUE(robot.twins.status(feed).in_step);
    EXPECT_FALSE(robot.twins.status(feed).counts);  // what settles does not count
  }
  robot.stopped = false;
  robot.run(14.0);
  for (const Feed feed : kFeeds) {
    EXPECT_EQ(robot.twins.status(feed).starts, 2);
    EXPECT_LT(robot.largest_gap(feed), 2.0);
  }
}

TEST(Twins, JumpOfThePosture) {
  MovingRobot robot = robot_with({});
  robot.run(4.0);
  robot.sim.skip(20);
  robot.sim.place({0.6}, {1.0, 1.0});
  robot.twins.hear(joint_sample(robot.sim, Topic::kJoints, robot.stamp()), Topic::kJoints);
  EXPECT_FALSE(robot.twins.time());
  EXPECT_EQ(robot.twins.status(Feed::kVoltages).why, "hinge jumped");
  robot.run(0.04);
  EXPECT_EQ(robot.twins.status(Feed::kPostures).starts, 2);
  EXPECT_GT(robot.sim.configuration()[0], 0.3);
  const Simulation& twin = robot.twins.sim(Feed::kPostures);
  EXPECT_NEAR(twin.configuration()[0], robot.sim.configuration()[0], 0.1);
}

TEST(Twins, RestartOfTheRobot) {
  MovingRobot robot = robot_with({});
  robot.clock = nanoseconds(100.0);
  robot.run(8.0);
  robot.clock = -nanoseconds(7.0);  // its time begins anew
  robot.run(0.01, [](MovingRobot& r) {
    r.hear();
    if (r.twins.time()) return;
    EXPECT_EQ(r.twins.status(Feed::kPostures).why, "time went back");
  });
  robot.run(14.0);
  ASSERT_TRUE(robot.twins.time());
  EXPECT_LT(seconds(*robot.twins.time()), 20.0);
  for (const Feed feed : kFeeds) EXPECT_LT(robot.largest_gap(feed), 2.0);
}

TEST(Twins, GapInTheMeasurement) {
  MovingRobot robot = robot_with({});
  robot.run(4.0);
  robot.run(0.6, [](MovingRobot&) {});
  robot.twins.hear(muscle_sample(robot.sim, robot.stamp()));
  EXPECT_FALSE(robot.twins.time());
  EXPECT_EQ(robot.twins.status(Feed::kCommands).why, "no muscle_states for 0.6 s");
  robot.run(4.0);
  EXPECT_EQ(robot.twins.status(Feed::kCommands).starts, 2);
}

TEST(Twins, JointsThatAreNotMeasured) {
  MovingRobot robot = robot_with({});
  const auto without_joints = [](MovingRobot& r) {
    r.twins.hear(muscle_sample(r.sim, r.stamp()));
    r.advance();
  };
  robot.run(8.0, without_joints);
  EXPECT_FALSE(robot.twins.status(Feed::kPostures).in_step);
  EXPECT_EQ(robot.twins.status(Feed::kPostures).why, "hinge is not measured");
  EXPECT_TRUE(robot.twins.status(Feed::kCommands).counts);
  EXPECT_LT(robot.gap("flexor/force", Feed::kCommands, 0), 2.0);
  EXPECT_TRUE(std::isnan(robot.gap("hinge/position", Feed::kCommands, 0)));
  robot.run(14.0);  // from now on it is
  EXPECT_TRUE(robot.twins.status(Feed::kPostures).counts);
  for (const Feed feed : kFeeds) EXPECT_LT(robot.largest_gap(feed), 2.0);
}

TEST(Twins, MotorThatIsNotMeasured) {
  MovingRobot robot = robot_with({});
  const auto with_fault = [](MovingRobot& r) {
    MuscleSample sample = muscle_sample(r.sim, r.stamp());
    sample.muscles[1] = {};
    r.twins.hear(sample);
    r.twins.hear(joint_sample(r.sim, Topic::kJoints, r.stamp()), Topic::kJoints);
    r.advance();
  };
  robot.run(4.0);
  robot.run(4.0, with_fault);
  EXPECT_FALSE(robot.twins.status(Feed::kPositions).in_step);
  EXPECT_EQ(robot.twins.status(Feed::kPositions).why, "extensor is not measured");
  EXPECT_TRUE(robot.twins.status(Feed::kCommands).in_step);
  EXPECT_FALSE(robot.twins.sim(Feed::kCommands).muscle(1).enabled());
}

TEST(Twins, StoppedMotorsAreUnpowered) {
  MovingRobot robot = robot_with({});
  robot.run(8.0);
  robot.stopped = true;
  for (int m = 0; m < 2; ++m) {
    robot.sim.command(m, ecu::Mode::kVoltage, 0.0);
    robot.sim.muscle_inputs().set_enabled(m, false);
  }
  robot.run(14.0);
  for (int m = 0; m < 2; ++m) {
    EXPECT_FALSE(robot.twins.sim(Feed::kCommands).muscle(m).enabled());
    EXPECT_EQ(robot.twins.sim(Feed::kVoltages).muscle(m).voltage(), 0.0);
  }
  for (const Feed feed : kFeeds) EXPECT_LT(robot.largest_gap(feed), 3.0) << index_of(feed);
}

/// Something that hangs on the arm from the fourth second on.
std::unique_ptr<MovingRobot> pushed_robot(bool known) {
  auto moving = std::make_unique<MovingRobot>(noisy_robot(rig_file()), *noisy_robot(rig_file()));
  MovingRobot& robot = *moving;
  robot.run(4.0);
  PushSample sample;
  sample.stamp = robot.stamp();
  sample.pushes.resize(1);
  sample.pushes[0].wrench.frame = robot.sim.model().skeleton->find_frame("arm");
  sample.pushes[0].wrench.force = Vec3(5.0, 0.0, 0.0);
  sample.pushes[0].wrench.point = Vec3(0.0, 0.0, -0.1);
  sample.pushes[0].wrench.steps_left = 12000;
  sample.pushes[0].end = sample.stamp + nanoseconds(12.0);
  robot.sim.external_wrenches().push(sample.pushes[0].wrench);
  if (known) robot.twins.hear(sample);
  robot.run(12.0);
  return moving;
}

TEST(Twins, PushesAreKnown) {
  const auto robot = pushed_robot(true);
  for (const Feed feed : kFeeds) EXPECT_LT(robot->largest_gap(feed), 2.0) << index_of(feed);
}

TEST(Twins, UnknownPushIsALoad) {
  const auto warnings = warnings_of(*pushed_robot(false));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].finding.owner, "hinge");
  EXPECT_EQ(warnings[0].finding.part, Part::kJoint);
}

TEST(Twins, GivenFloors) {
  const auto model = noisy_robot(rig_file());
  Twins twins(*model, TwinOptions{}, {{"flexor/force", 50.0}});
  MovingRobot robot(model, *model);
  robot.run(14.0, [&](MovingRobot& r) {
    twins.hear(muscle_sample(r.sim, r.stamp()));
    twins.hear(joint_sample(r.sim, Topic::kJoints, r.stamp()), Topic::kJoints);
    while (twins.advance()) {
    }
  });
  EXPECT_EQ(twins.report().floor[twins.report().floor_at(0, Feed::kPostures)], 50.0);
  EXPECT_LT(twins.report().gap[twins.report().at(1, 0, Feed::kPostures)], 0.01);
}

}  // namespace
}  // namespace twin
}  // namespace anthrob
