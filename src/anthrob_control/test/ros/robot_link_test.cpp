#include "anthrob_control/ros/robot_link.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "anthrob_control/ros/reference_watch.h"

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
  const auto released = make_command(*model, ecu::Mode::kForce, references, true);
  ASSERT_EQ(released.name.size(), 13u);
  for (std::size_t m = 0; m < 13; ++m) {
    const bool hand = released.name[m].rfind("hand", 0) == 0;
    EXPECT_EQ(released.mode[m],
              static_cast<std::uint8_t>(hand ? ecu::Mode::kVoltage : ecu::Mode::kForce));
    EXPECT_EQ(released.reference[m], hand ? 0.0 : 2.0);
  }
}

TEST(ReferenceWatch, NamesAMuscleThatFollowsSomethingElseForASecond) {
  const auto model =
      load_robot_model(std::string(ANTHROB_CONFIG_DIR) + "/two_muscle_rig/model_I.yaml");
  RobotState state(model);
  for (const char* muscle : {"flexor", "extensor"}) {
    state.see_muscle(muscle, {0.1, 0.0, 0.0, 5.0}, true, 10.0);
    state.see_mode(muscle, ecu::Mode::kVoltage);
  }
  ReferenceWatch sure, watch, other;
  sure.look(state, ros::Time(10.0), true);
  sure.look(state, ros::Time(10.9), true);
  EXPECT_THROW(sure.look(state, ros::Time(11.1), true), std::runtime_error);
  // Simulated time may run ahead of what is under way.
  watch.look(state, ros::Time(10.0), false);
  watch.look(state, ros::Time(20.0), false);
  // A moment in between, or time that was set back, begins anew.
  other.look(state, ros::Time(10.0), true);
  state.see_mode("flexor", ecu::Mode::kPosition);
  state.see_mode("extensor", ecu::Mode::kPosition);
  other.look(state, ros::Time(10.9), true);
  state.see_mode("extensor", ecu::Mode::kVoltage);
  other.look(state, ros::Time(30.0), true);
  other.look(state, ros::Time(5.0), true);
  other.look(state, ros::Time(5.9), true);
  EXPECT_THROW(other.look(state, ros::Time(6.1), true), std::runtime_error);
}

}  // namespace
}  // namespace anthrob
