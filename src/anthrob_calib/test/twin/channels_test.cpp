#include "twin/channels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "twin/moving_robot.h"

namespace anthrob {
namespace twin {
namespace {

TEST(Channels, OfAnthrob) {
  const auto model = load_robot_model(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml");
  const TwinOptions options;
  const Channels channels(*model, options);
  ASSERT_EQ(channels.all.size(), 11u * 3 + 2);
  EXPECT_EQ(channels.all[0].name, "lateral_deltoid/force");
  EXPECT_EQ(channels.all[2].name, "lateral_deltoid/current");
  const Channel &ball = channels.all[33], &hinge = channels.all[34];
  EXPECT_EQ(ball.name, "shoulder/rotation");
  EXPECT_EQ(ball.components, 3);
  EXPECT_EQ(hinge.name, "elbow/position");
  EXPECT_EQ(hinge.series, ball.series + 3);
  EXPECT_EQ(channels.series, 37u);
  EXPECT_EQ(channels.values, 38u);
  EXPECT_DOUBLE_EQ(hinge.least, options.least_angle);
}

TEST(Channels, CountsAreTheLeastFloor) {
  const auto model =
      load_robot_model(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_II_noisy.yaml");
  const Channels channels(*model, TwinOptions{});
  EXPECT_DOUBLE_EQ(channels.all[0].least, 0.122 / std::sqrt(12.0));
  EXPECT_DOUBLE_EQ(channels.all[1].least, 0.0061 / std::sqrt(12.0));
  EXPECT_DOUBLE_EQ(channels.all[0].cut_noise, 0.3);
}

TEST(Channels, ForceThatIsCutOffAtZero) {
  // Of a slack tendon, the mean of a normal number's positive part: sigma / sqrt(2 pi).
  EXPECT_NEAR(mean_above_zero(0.0, 0.3), 0.3 / std::sqrt(2.0 * M_PI), 1e-12);
  EXPECT_NEAR(mean_above_zero(5.0, 0.3), 5.0, 1e-12);
  EXPECT_DOUBLE_EQ(mean_above_zero(2.0, 0.0), 2.0);
  EXPECT_NEAR(mean_above_zero(0.3, 0.3) - mean_above_zero(-0.3, 0.3), 0.3, 1e-12);
}

TEST(Channels, RotationInTheChildsAxes) {
  const auto model = load_robot_model(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml");
  const Channels channels(*model, TwinOptions{});
  const Channel& ball = channels.all[33];
  const JointModel& joint = model->skeleton->joints[static_cast<std::size_t>(ball.index)];
  const Quat here(Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 2.0) / 3.0));
  const Vec3 small(0.01, -0.02, 0.03);
  const Quat there = here * quaternion_of(small);
  std::vector<double> values(channels.values, 0.0);
  JointSample sample = blank_joints(*model);
  const auto put = [](const Quat& turn, double* to) {
    to[0] = turn.w(), to[1] = turn.x(), to[2] = turn.y(), to[3] = turn.z();
  };
  put(here, &values[ball.value]);
  double result[3];
  difference(ball, joint, sample, values, result);
  EXPECT_TRUE(std::isnan(result[0]));
  put(Quat(-there.w(), -there.x(), -there.y(), -there.z()),
      &sample.q[static_cast<std::size_t>(joint.position_offset)]);
  difference(ball, joint, sample, values, result);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(result[k], small[k], 1e-12);
}

}  // namespace
}  // namespace twin
}  // namespace anthrob
