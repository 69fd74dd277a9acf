#include "anthrob_control/ros/robot_link.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

TEST(MakeCommand, LeavesMusclesOutThatLackTheMode) {
  const auto model =
      load_robot_model(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_II_hand.yaml");
  const std::vector<double> references(model->muscles.size(), 2.0);
  const auto position = make_command(*model, ecu::Mode::kPosition, references);
  EXPECT_EQ(position.name.size(), 13u);
  const auto force = make_command(*model, ecu::Mode::kForce, references);
  EXPECT_EQ(force.name.size(), 11u);  // the hand's two have no force sensor
  EXPECT_EQ(force.mode.size(), 11u);
  EXPECT_EQ(force.reference.size(), 11u);
  for (const std::string& name : force.name) EXPECT_EQ(name.rfind("hand", 0), std::string::npos);
}

}  // namespace
}  // namespace anthrob
