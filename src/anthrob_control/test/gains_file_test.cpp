#include "anthrob_control/gains_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "anthrob_sim/core/errors.h"

namespace anthrob {
namespace {

const std::string kModel = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_II.yaml";

TEST(GainsFile, LoadsAsTheModelWithTheGainsThatWereHeld) {
  const auto model = load_robot_model(kModel);
  HeldGains held;
  // As units hold them: a float that is the model's number, and others.
  const double own = model->muscles[0].controller.position.proportional;
  held["lateral_deltoid"] = {{"position_proportional", static_cast<float>(own)},
                             {"force_integral", 0.1f}};
  held["teres_minor"] = {{"force_integral", 0.1f}};
  held["brachialis"] = {
      {"position_proportional", model->muscles[10].controller.position.proportional}};
  const std::string text = gains_file(*model, held, kModel);
  EXPECT_NE(text.find("integral: 0.1,"), std::string::npos) << text;

  const auto folder =
      std::filesystem::temp_directory_path() / ("anthrob_gains_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::filesystem::copy(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/robot.urdf",
                        folder / "robot.urdf");
  std::ofstream(folder / "model.yaml") << text;
  const auto tuned = load_robot_model((folder / "model.yaml").string());
  std::filesystem::remove_all(folder);
  ASSERT_EQ(tuned->muscles.size(), model->muscles.size());
  for (std::size_t m = 0; m < model->muscles.size(); ++m) {
    const MuscleModel &a = model->muscles[m], &b = tuned->muscles[m];
    const bool changed = a.name == "lateral_deltoid" || a.name == "teres_minor";
    EXPECT_EQ(b.controller.force.integral, changed ? 0.1 : a.controller.force.integral) << a.name;
    EXPECT_EQ(b.controller.position.proportional, a.controller.position.proportional);
    EXPECT_EQ(b.controller.current.integral, a.controller.current.integral);
    EXPECT_EQ(b.controller.voltage_limit, a.controller.voltage_limit);
    EXPECT_EQ(b.limits.position, a.limits.position);
    EXPECT_EQ(b.limits.current, a.limits.current);
    EXPECT_EQ(b.limits.force, a.limits.force);
    EXPECT_EQ(b.steps_per_tick, a.steps_per_tick);
  }
}

TEST(GainsFile, IsEmptyWhereNothingDiffers) {
  const auto model = load_robot_model(kModel);
  HeldGains held;
  held["lateral_deltoid"] = {
      {"position_proportional",
       static_cast<float>(model->muscles[0].controller.position.proportional)}};
  EXPECT_EQ(gains_file(*model, held, kModel), "");
}

TEST(GainsFile, OfAnotherRobotIsRefused) {
  const auto model = load_robot_model(kModel);
  EXPECT_THROW(gains_file(*model, {{"flexor", {{"force_integral", 1.0}}}}, kModel), BadInput);
}

}  // namespace
}  // namespace anthrob
