// Stops and time-outs of driven joints: the effort is gone, and comes back only when it may.
#include "simulation/driven_joints.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support.h"

namespace anthrob {
namespace {

using testing_support::config;

constexpr double kTimeout = 0.5;  // [s]

/// The driven axis, advanced as the node does it.
class Axis {
 public:
  explicit Axis(bool auto_enable)
      : sim_(load_robot_model(config("driven_axis/model_I.yaml"))),
        joints_(*sim_.model().skeleton, {kTimeout, auto_enable}) {}

  ecu::Supervisor& supervisor() { return joints_.supervisor(); }
  ecu::Supervisor::Outcome push(double effort) { return joints_.command({"axis"}, {effort}, sim_); }
  ecu::Supervisor::Outcome command(const std::vector<std::string>& names,
                                   const std::vector<double>& efforts) {
    return joints_.command(names, efforts, sim_);
  }
  double effort() {
    joints_.apply(sim_);
    return sim_.joint_effort(0);
  }
  void run(double seconds) {
    const double end = sim_.time() + seconds - 1e-9;
    while (sim_.time() < end) {
      if (supervisor().update(sim_.time())) joints_.apply(sim_);
      sim_.step();
    }
  }
  double velocity() const { return sim_.read_velocity(0); }
  const DrivenJoints& joints() const { return joints_; }

 private:
  Simulation sim_;
  DrivenJoints joints_;
};

TEST(DrivenJoints, FollowAtOnceOnlyWithAutoEnable) {
  Axis willing(true), waiting(false);
  EXPECT_TRUE(willing.push(50.0).accepted);
  EXPECT_EQ(willing.effort(), 50.0);
  const auto outcome = waiting.push(50.0);
  EXPECT_FALSE(outcome.accepted);
  EXPECT_NE(outcome.reason.find("call enable"), std::string::npos) << outcome.reason;
  EXPECT_EQ(waiting.effort(), 0.0);
  waiting.supervisor().enable(0.0);
  EXPECT_EQ(waiting.effort(), 0.0);  // what was refused is not kept
  EXPECT_TRUE(waiting.push(50.0).accepted);
  EXPECT_EQ(waiting.effort(), 50.0);
}

TEST(DrivenJoints, EmergencyStopIsLatched) {
  Axis axis(true);
  axis.push(50.0);
  axis.run(0.1);
  axis.supervisor().emergency_stop();
  EXPECT_EQ(axis.effort(), 0.0);
  const auto refused = axis.push(50.0);
  EXPECT_FALSE(refused.accepted);
  EXPECT_NE(refused.reason.find("clear_faults"), std::string::npos) << refused.reason;
  EXPECT_EQ(axis.joints().last_rejection(), refused.reason);
  EXPECT_FALSE(axis.supervisor().enable(0.1).accepted);
  axis.supervisor().clear_faults();
  EXPECT_FALSE(axis.push(50.0).accepted);
  EXPECT_TRUE(axis.supervisor().enable(0.1).accepted);
  EXPECT_EQ(axis.effort(), 0.0);
  EXPECT_TRUE(axis.push(50.0).accepted);
  EXPECT_EQ(axis.effort(), 50.0);
}

TEST(DrivenJoints, DisableTakesTheEffort) {
  Axis axis(false);
  axis.supervisor().enable(0.0);
  axis.push(50.0);
  axis.supervisor().disable();
  EXPECT_EQ(axis.effort(), 0.0);
  EXPECT_FALSE(axis.push(50.0).accepted);
}

TEST(DrivenJoints, EffortThatNobodyRenewsEnds) {
  Axis axis(true);
  axis.push(50.0);
  axis.run(0.4);
  EXPECT_EQ(axis.effort(), 50.0);
  axis.push(50.0);
  axis.run(0.4);
  EXPECT_EQ(axis.effort(), 50.0);
  axis.run(0.2);
  EXPECT_EQ(axis.effort(), 0.0);
  // From here the carriage coasts: m dv/dt = -d v, with m = 95.1 kg, d = 203.5 Ns/m.
  const double before = axis.velocity();
  axis.run(0.2);
  EXPECT_NEAR(axis.velocity() / before, std::exp(-203.5 / 95.1 * 0.2), 1e-3);
  EXPECT_TRUE(axis.push(20.0).accepted);  // as of muscles: the next command resumes
  EXPECT_EQ(axis.effort(), 20.0);
}

TEST(DrivenJoints, MalformedCommandsAreRefusedWhole) {
  Axis axis(true);
  axis.push(5.0);
  EXPECT_FALSE(axis.command({}, {}).accepted);
  EXPECT_FALSE(axis.command({"axis"}, {}).accepted);
  EXPECT_FALSE(axis.command({"axis"}, {1.0, 2.0}).accepted);
  EXPECT_FALSE(axis.command({"axis", "axis"}, {1.0, 2.0}).accepted);
  EXPECT_FALSE(axis.command({"axis", "nobody"}, {1.0, 2.0}).accepted);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    EXPECT_FALSE(axis.push(bad).accepted);
  }
  EXPECT_EQ(axis.joints().rejected_count(), 8u);
  EXPECT_EQ(axis.effort(), 5.0);
}

TEST(DrivenJoints, RobotWithoutThemHasNothingToDo) {
  Simulation sim(load_robot_model(config("two_muscle_rig/model_I.yaml")));
  DrivenJoints joints(*sim.model().skeleton, {kTimeout, true});
  EXPECT_TRUE(joints.supervisor().muscles().empty());
  EXPECT_FALSE(joints.command({"hinge"}, {1.0}, sim).accepted);
  EXPECT_TRUE(joints.supervisor().emergency_stop().accepted);
  joints.apply(sim);
}

}  // namespace
}  // namespace anthrob
