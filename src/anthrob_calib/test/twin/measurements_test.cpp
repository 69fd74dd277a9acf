#include "twin/measurements.h"

#include <gtest/gtest.h>

#include "twin/moving_robot.h"

namespace anthrob {
namespace twin {
namespace {

class OfRig : public ::testing::Test {
 protected:
  MuscleSample muscles(double time, double position = 0.0, double velocity = 0.0) const {
    MuscleSample sample = blank_muscles(*model_);
    sample.stamp = nanoseconds(time);
    for (MuscleReading& reading : sample.muscles) {
      reading.position = position;
      reading.velocity = velocity;
    }
    return sample;
  }
  JointSample joints(double time, double position = 0.0) const {
    JointSample sample = blank_joints(*model_);
    sample.stamp = nanoseconds(time);
    sample.q[0] = position;
    sample.velocity[0] = 0.0;
    return sample;
  }
  std::string broken(const std::optional<Break>& by) const { return by ? by->why : "none"; }

  std::shared_ptr<const RobotModel> model_ = load_robot_model(rig_file());
  Measurements measured_{*model_, TwinOptions{}};
};

TEST_F(OfRig, AllTopicsAreAwaited) {
  EXPECT_TRUE(measured_.needed(Topic::kJoints));
  EXPECT_FALSE(measured_.needed(Topic::kBallJoints));
  EXPECT_FALSE(measured_.start());
  measured_.hear(muscles(1.0));
  EXPECT_FALSE(measured_.start());
  measured_.hear(joints(1.01), Topic::kJoints);
  EXPECT_FALSE(measured_.start());  // the muscles are not measured there yet
  measured_.hear(muscles(1.02));
  EXPECT_FALSE(measured_.start());
  measured_.hear(joints(1.03), Topic::kJoints);
  EXPECT_EQ(measured_.start(), nanoseconds(1.02));
  EXPECT_EQ(measured_.horizon(), nanoseconds(1.02));
}

TEST_F(OfRig, ButNotForEver) {
  for (int i = 0; i <= 100; ++i) {
    measured_.hear(muscles(0.01 * i));
    EXPECT_FALSE(measured_.start()) << i;
  }
  measured_.hear(muscles(1.01));
  EXPECT_EQ(measured_.start(), 0);
  EXPECT_FALSE(measured_.alive(Topic::kJoints));
}

TEST_F(OfRig, LateAndRepeated) {
  measured_.hear(muscles(0.0));
  measured_.hear(muscles(0.01));
  measured_.forget_before(nanoseconds(0.01), nanoseconds(0.01));
  EXPECT_EQ(broken(measured_.hear(muscles(0.01))), "none");
  EXPECT_EQ(broken(measured_.hear(muscles(0.005))), "none");
  measured_.hear(muscles(0.03));
  measured_.hear(muscles(0.02));  // in time, in any order
  const Arrivals& arrivals = measured_.arrivals(Topic::kMuscles);
  EXPECT_EQ(arrivals.repeated, 1);
  EXPECT_EQ(arrivals.late, 1);
  EXPECT_EQ(arrivals.heard, 4);
  EXPECT_EQ(measured_.muscles()[1].stamp, nanoseconds(0.02));
}

TEST_F(OfRig, TimeThatGoesBack) {
  measured_.hear(muscles(5.0));
  measured_.hear(joints(5.0), Topic::kJoints);
  EXPECT_EQ(broken(measured_.hear(muscles(4.0))), "time went back");
  EXPECT_TRUE(measured_.joints(Topic::kJoints).empty());
  EXPECT_EQ(measured_.muscles().size(), 1u);
}

TEST_F(OfRig, TimeThatGoesBackALittle) {
  measured_.hear(muscles(5.0));
  measured_.forget_before(nanoseconds(5.0), nanoseconds(5.0));
  const TwinOptions options;
  for (int i = 0; i < options.late_in_row; ++i) {
    EXPECT_EQ(broken(measured_.hear(muscles(4.7 + 0.001 * i))), "none");
  }
  EXPECT_EQ(broken(measured_.hear(muscles(4.8))), "time went back");
}

TEST_F(OfRig, ATopicThatLagsHasNotGoneBack) {
  measured_.hear(muscles(0.0));
  measured_.hear(joints(0.0), Topic::kJoints);
  for (int i = 1; i <= 200; ++i) measured_.hear(muscles(0.01 * i));
  EXPECT_FALSE(measured_.alive(Topic::kJoints));
  measured_.forget_before(nanoseconds(2.0), nanoseconds(2.0));
  for (int i = 1; i <= 200; ++i)
    EXPECT_EQ(broken(measured_.hear(joints(0.01 * i), Topic::kJoints)), "none");
  EXPECT_EQ(measured_.arrivals(Topic::kJoints).late, 200);
  EXPECT_TRUE(measured_.alive(Topic::kJoints));
}

TEST_F(OfRig, Gaps) {
  measured_.hear(muscles(0.0));
  EXPECT_EQ(broken(measured_.hear(muscles(0.25))), "none");
  const auto gap = measured_.hear(muscles(0.75));
  EXPECT_EQ(broken(gap), "no muscle_states for 0.5 s");
  EXPECT_TRUE(gap->of_all);
  measured_.hear(joints(0.0), Topic::kJoints);
  const auto of_joints = measured_.hear(joints(0.5), Topic::kJoints);
  EXPECT_EQ(broken(of_joints), "no joint_states for 0.5 s");
  EXPECT_FALSE(of_joints->of_all);
}

TEST_F(OfRig, WhatIsNotMeasured) {
  measured_.hear(muscles(0.0));
  MuscleSample without = muscles(0.1);
  without.muscles[1].position = kNotMeasured;
  EXPECT_EQ(broken(measured_.hear(without)), "none");
  EXPECT_EQ(measured_.arrivals(Topic::kMuscles).incomplete, 1);
  without.stamp = nanoseconds(0.3);
  EXPECT_EQ(broken(measured_.hear(without)), "extensor not measured for 0.3 s");
  EXPECT_TRUE(measured_.measured_muscle(0));
  EXPECT_FALSE(measured_.measured_muscle(1));
}

TEST_F(OfRig, JumpsAreFasterThanMeasured) {
  measured_.hear(muscles(0.0));
  EXPECT_EQ(broken(measured_.hear(muscles(0.02, 0.04))), "none");  // noise
  EXPECT_EQ(broken(measured_.hear(muscles(0.04, 0.3, 7.0))), "none");
  EXPECT_EQ(broken(measured_.hear(muscles(0.06, 0.3))), "none");
  EXPECT_EQ(broken(measured_.hear(muscles(0.08, 0.0))), "flexor jumped");
  measured_.hear(joints(0.0), Topic::kJoints);
  EXPECT_EQ(broken(measured_.hear(joints(0.02, 0.2), Topic::kJoints)), "hinge jumped");
}

}  // namespace
}  // namespace twin
}  // namespace anthrob
