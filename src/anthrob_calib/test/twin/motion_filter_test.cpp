#include "twin/motion_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "twin/moving_robot.h"

namespace anthrob {
namespace twin {
namespace {

constexpr double kCount = 0.006, kSmooth = 0.1;
constexpr Nanoseconds kStep = 1000000, kPeriod = 2000000, kAverage = 10000000;

double angle_at(double time) {
  return 0.5 * std::sin(2.0 * time);
}
double speed_at(double time) {
  return std::cos(2.0 * time);
}

Timeline<MuscleSample> counted(const RobotModel& model, bool with_speed) {
  Timeline<MuscleSample> timeline(blank_muscles(model), 2000);
  MuscleSample sample = blank_muscles(model);
  for (sample.stamp = 0; sample.stamp <= nanoseconds(2.0); sample.stamp += kPeriod) {
    const double time = seconds(sample.stamp);
    sample.muscles[0].position = kCount * std::round(angle_at(time) / kCount);
    if (with_speed) sample.muscles[0].velocity = speed_at(time);
    timeline.insert(sample);
  }
  return timeline;
}

TEST(MotionFilter, CountsMakeNoSpeed) {
  const auto model = load_robot_model(rig_file());
  const auto timeline = counted(*model, true);
  double position = position_at(timeline, 0, 0);
  for (Nanoseconds t = 0; t < nanoseconds(1.9); t += kStep) {
    const double next = smooth_position(timeline, 0, t, kStep, kSmooth, kAverage, position);
    const double speed = (next - position) / seconds(kStep);
    position = next;
    // Counts alone would be 6 rad/s from one measurement to the next.
    EXPECT_NEAR(speed, speed_at(seconds(t)), 0.05);
    EXPECT_NEAR(position, angle_at(seconds(t + kStep)), 0.5 * kCount);
  }
}

TEST(MotionFilter, WithoutSpeedAsMeasured) {
  const auto model = load_robot_model(rig_file());
  const auto timeline = counted(*model, false);
  const Nanoseconds t = nanoseconds(0.5);
  EXPECT_DOUBLE_EQ(smooth_position(timeline, 0, t, kStep, kSmooth, kAverage, 77.0),
                   position_at(timeline, 0, t + kStep));
  EXPECT_TRUE(std::isnan(position_at(timeline, 1, t)));
}

TEST(MotionFilter, BallJointTurnsAtItsSpeed) {
  const auto model = load_robot_model(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml");
  const JointModel& joint =
      model->skeleton->joints[static_cast<std::size_t>(model->skeleton->find_joint("shoulder"))];
  const auto q = static_cast<std::size_t>(joint.position_offset),
             v = static_cast<std::size_t>(joint.velocity_offset);
  const Vec3 speed(0.3, -0.2, 0.5);  // constant in the child's axes
  Timeline<JointSample> timeline(blank_joints(*model), 2000);
  JointSample sample = blank_joints(*model);
  const auto turn_after = [&](double time) { return quaternion_of(time * speed); };
  for (sample.stamp = 0; sample.stamp <= nanoseconds(1.0); sample.stamp += kPeriod) {
    const Quat turn = turn_after(seconds(sample.stamp));
    sample.q[q] = turn.w(), sample.q[q + 1] = turn.x();
    sample.q[q + 2] = turn.y(), sample.q[q + 3] = turn.z();
    Eigen::Map<Vec3>(&sample.velocity[v]) = speed;
    timeline.insert(sample);
  }
  std::vector<double> posture = model->skeleton->rest_configuration();
  for (Nanoseconds t = 0; t < nanoseconds(1.0); t += kStep) {
    smooth_joint(timeline, joint, t, kStep, kSmooth, posture);
  }
  const Quat reached(posture[q], posture[q + 1], posture[q + 2], posture[q + 3]);
  EXPECT_NEAR(angular_distance(reached, turn_after(1.0)), 0.0, 1e-6);
}

}  // namespace
}  // namespace twin
}  // namespace anthrob
