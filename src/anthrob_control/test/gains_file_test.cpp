#include "gains_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace {

const std::string kModel = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_II.yaml";

/// A folder with the robot's skeleton, for model files.
class Folder {
 public:
  Folder() {
    std::filesystem::create_directories(path_);
    std::filesystem::copy(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/robot.urdf",
                          path_ / "robot.urdf");
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return (path_ / name).string();
  }

 private:
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("anthrob_gains_" + std::to_string(::getpid()));
};

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
  const Folder folder;
  const std::string first = folder.write("model_tuned.yaml", gains_file(*model, held, kModel));
  const auto tuned = load_robot_model(first);
  // Saved once more, on top of it, after one more change and one back to the model's.
  held["lateral_deltoid"]["force_integral"] = model->muscles[0].controller.force.integral;
  held["brachialis"]["force_integral"] = 0.3f;
  const auto again =
      load_robot_model(folder.write("model_again.yaml", gains_file(*tuned, held, first)));
  ASSERT_EQ(tuned->muscles.size(), model->muscles.size());
  for (std::size_t m = 0; m < model->muscles.size(); ++m) {
    const MuscleModel &a = model->muscles[m], &b = tuned->muscles[m], &c = again->muscles[m];
    const bool deltoid = a.name == "lateral_deltoid", minor = a.name == "teres_minor";
    const double plain = a.controller.force.integral;
    EXPECT_EQ(b.controller.force.integral, deltoid || minor ? 0.1 : plain) << a.name;
    EXPECT_EQ(c.controller.force.integral, minor                    ? 0.1
                                           : a.name == "brachialis" ? 0.3
                                                                    : plain)
        << a.name;
    for (const MuscleModel* saved : {&b, &c}) {
      EXPECT_EQ(saved->controller.position.proportional, a.controller.position.proportional);
      EXPECT_EQ(saved->controller.current.integral, a.controller.current.integral);
      EXPECT_EQ(saved->controller.voltage_limit, a.controller.voltage_limit);
      EXPECT_EQ(saved->limits.current, a.limits.current);
    }
  }
}

TEST(GainsFile, OnlyExtendsTheModelWhereNothingDiffers) {
  const auto model = load_robot_model(kModel);
  HeldGains held;
  held["lateral_deltoid"] = {
      {"position_proportional",
       static_cast<float>(model->muscles[0].controller.position.proportional)}};
  const std::string text = gains_file(*model, held, kModel);
  EXPECT_NE(text.find("extends: "), std::string::npos) << text;
  EXPECT_EQ(text.find("muscles"), std::string::npos) << text;
}

TEST(GainsFile, OfAnotherRobotIsRefused) {
  const auto model = load_robot_model(kModel);
  EXPECT_THROW(gains_file(*model, {{"flexor", {{"force_integral", 1.0}}}}, kModel), BadInput);
}

}  // namespace
}  // namespace anthrob
