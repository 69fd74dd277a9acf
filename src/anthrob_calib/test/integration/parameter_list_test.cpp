#include "anthrob_core/parameter_list.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "anthrob_core/errors.h"
#include "anthrob_sim/actuator/actuator.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {
namespace {

const char* const kModel = R"(
muscles:
  flexor: {spindle_radius: 0.006, path: [{point: [0, 1, 2]}, {point: [3, 4, 5]}, {point: [6, 7, 8]}]}
  extensor: {spindle_radius: 0.007, path: [{point: [0, 1, 2]}, {radius: 0.01}, {point: [6, 7, 8]}]}
joints:
  elbow: {friction: {viscous: 0.02}}
)";

std::vector<ModelParameter> read(const std::string& list) {
  return read_parameters(ConfigNode::parse(list, "calibration.yaml"),
                         ConfigNode::parse(kModel, "model.yaml"));
}

std::string error_of(const std::string& list) {
  try {
    read(list);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "no error";
}

TEST(ParameterList, PatternsFindTheirNumbers) {
  const auto radii =
      read("- {path: muscles.*.spindle_radius, unit: m, range: 0.0005, step: 0.0001}");
  ASSERT_EQ(radii.size(), 2u);
  EXPECT_EQ(radii[0].path, "muscles.flexor.spindle_radius");
  EXPECT_EQ(radii[0].name(), "flexor.spindle_radius");
  EXPECT_DOUBLE_EQ(radii[1].lower, 0.0065);
  EXPECT_DOUBLE_EQ(radii[1].upper, 0.0075);

  const auto points =
      read("- {path: 'muscles.{flexor}.path.-2.point.*', unit: m, range: 0.0025, step: 0.001}");
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[2].path, "muscles.flexor.path.1.point.2");
  EXPECT_EQ(points[2].name(), "flexor.path.1.z");
  EXPECT_DOUBLE_EQ(points[2].initial, 5.0);

  EXPECT_TRUE(
      read("- {path: muscles.*.nothing, unit: m, range: 1, step: 1, if_present: true}").empty());

  const auto viscous =
      read("- {path: joints.*.friction.viscous, unit: Nms/rad, low: 0.0, high: 0.5, step: 0.05}");
  ASSERT_EQ(viscous.size(), 1u);
  EXPECT_DOUBLE_EQ(viscous[0].upper, 0.5);
}

TEST(ParameterList, RefusesWhatCannotBeMeant) {
  EXPECT_NE(
      error_of("- {path: muscles.*.nothing, unit: m, range: 1, step: 1}")
          .find("calibration.yaml:1: 0.path: muscles.*.nothing: expected the path of a number"),
      std::string::npos)
      << error_of("- {path: muscles.*.nothing, unit: m, range: 1, step: 1}");
  EXPECT_NE(error_of("- {path: muscles.flexor.path.-99999999999999999999999.point.0, unit: m, "
                     "range: 1, step: 1}")
                .find("expected the path of a number"),
            std::string::npos);
  EXPECT_NE(error_of("- {path: joints.elbow.friction.viscous, unit: x, low: 1, high: 2, step: 1}")
                .find(": expected 1 to 2, its low and high"),
            std::string::npos);
  EXPECT_NE(error_of("- {path: joints.elbow.friction.viscous, unit: x, low: 2, high: 1, step: 1}")
                .find("more than low"),
            std::string::npos);
  EXPECT_NE(error_of("- {path: muscles.flexor.spindle_radius, unit: m, range: 1, step: 1}\n"
                     "- {path: muscles.*.spindle_radius, unit: m, range: 1, step: 1}")
                .find("which another entry matches already"),
            std::string::npos);
  EXPECT_NE(error_of("- {path: muscles.*.spindle_radius, unit: m, range: -1, step: 1}").find("-1"),
            std::string::npos);
  const std::string entry = "- {path: muscles.*.spindle_radius, unit: m, step: 1, ";
  for (const char* end : {"range: 1, low: 0}", "range: 1, high: 2}"}) {
    EXPECT_EQ(
        error_of(entry + end),
        "calibration.yaml:1: 0.range: given together with low or high; expected either range, or "
        "low and high");
  }
  EXPECT_EQ(error_of(entry + "range: 1, lower: 0}"), "calibration.yaml:1: 0.lower: unknown key");
  const std::string two =
      "- {path: 'muscles.{flexor, extensr}.spindle_radius', unit: m, range: 1, ";
  EXPECT_NE(error_of(two + "step: 1}").find("0.path: 'extensr' matches no number in "),
            std::string::npos)
      << error_of(two + "step: 1}");
  EXPECT_EQ(error_of(two + "step: 1, if_present: true}"), "no error");
  EXPECT_EQ(error_of("- {path: nowhere, if_presnt: true, unit: m, range: 1, step: 1}"),
            "calibration.yaml:1: 0.if_presnt: unknown key");
}

TEST(ParameterList, OverridesReachTheModel) {
  const std::string file = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml";
  const ConfigNode model = ConfigNode::load(file);
  const auto list = ConfigNode::load(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/calibration.yaml");
  const auto parameters = read_parameters(list.at("parameters"), model);
  ASSERT_GT(parameters.size(), 50u);
  std::vector<double> values;
  for (const ModelParameter& p : parameters) values.push_back(p.initial);
  values[0] = parameters[0].initial + 0.001;
  LoadOptions options;
  options.overrides = overrides_of(parameters, values);
  const auto plain = build_robot_model(model), other = build_robot_model(model, options);
  const double l0 = plain->muscles[0].actuator->position_for(0.3);
  const double l1 = other->muscles[0].actuator->position_for(0.3);
  EXPECT_NEAR(l1 - l0, 0.001 / 0.0065, 1e-9);
}

TEST(OrdinaryParameters, AreThereForEveryModelOfAnthrob) {
  namespace fs = std::filesystem;
  int models = 0;
  for (const auto& entry : fs::directory_iterator(std::string(ANTHROB_CONFIG_DIR) + "/anthrob")) {
    if (entry.path().filename().string().rfind("model_", 0) != 0) continue;
    EXPECT_GT(ordinary_parameters(entry.path().string()).size(), 20u) << entry.path();
    ++models;
  }
  EXPECT_GE(models, 9);
}

TEST(OrdinaryParameters, ReachToWhereACalibrationWent) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("anthrob_widened_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string model = (folder / "model.yaml").string();
  std::ofstream(model) << "extends: " << ANTHROB_CONFIG_DIR << "/anthrob/model_I.yaml\n"
                       << "joints: {elbow: {friction: {viscous: 0.08}}}\n";
  double upper = 0.0;
  for (const ModelParameter& p : ordinary_parameters(model)) {
    if (p.path == "joints.elbow.friction.viscous") upper = p.upper;
  }
  EXPECT_DOUBLE_EQ(upper, 0.08);
  std::filesystem::remove_all(folder);
}

TEST(OrdinaryParameters, TellWhatOfTheirFileDoesNotCount) {
  const std::string model = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml";
  const auto file = (std::filesystem::temp_directory_path() /
                     ("anthrob_ordinary_" + std::to_string(getpid()) + ".yaml"))
                        .string();
  const std::string list =
      "parameters:\n  - {path: joints.elbow.friction.viscous, unit: Nms/rad, low: 0.01, "
      "high: 0.03, step: 0.01}\n";
  std::vector<std::string> remarks;
  std::ofstream(file) << list;
  EXPECT_EQ(ordinary_parameters(model, file, &remarks).size(), 1u);
  EXPECT_TRUE(remarks.empty());
  std::ofstream(file) << list << "shares: []\nrecordings: equilibria\n";
  EXPECT_EQ(ordinary_parameters(model, file, &remarks).size(), 1u);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].find(file + ": "), 0u) << remarks[0];
  EXPECT_NE(remarks[0].find("shares"), std::string::npos) << remarks[0];
  std::ofstream(file) << list << "paramters: []\n";
  try {
    ordinary_parameters(model, file, &remarks);
    ADD_FAILURE() << "not refused";
  } catch (const BadInput& error) {
    EXPECT_EQ(error.what(), file + ":3: paramters: unknown key");
  }
  std::filesystem::remove(file);
}

TEST(OrdinaryParameters, AreThoseBesideTheModelOrBesideTheOneItExtends) {
  const std::string model = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml";
  const auto folder =
      std::filesystem::temp_directory_path() / ("anthrob_ordinary_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string extended = (folder / "model.yaml").string();
  std::ofstream(extended) << "extends: " << model << "\n";
  const auto own = ordinary_parameters(model), inherited = ordinary_parameters(extended);
  EXPECT_FALSE(own.empty());
  ASSERT_EQ(inherited.size(), own.size());
  EXPECT_EQ(inherited.back().path, own.back().path);
  const std::string beside = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/calibration.yaml";
  EXPECT_TRUE(std::filesystem::equivalent(calibration_file_of(extended).value(), beside));
  EXPECT_EQ(calibration_file_of(extended, "mine.yaml"), "mine.yaml");

  std::ofstream(folder / "calibration.yaml")
      << "parameters:\n  - {path: joints.elbow.friction.viscous, unit: Nms/rad, low: 0.01, "
         "high: 0.03, step: 0.01}\n";
  EXPECT_EQ(ordinary_parameters(extended).size(), 1u);
  EXPECT_EQ(ordinary_parameters(model, (folder / "calibration.yaml").string()).size(), 1u);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace anthrob
