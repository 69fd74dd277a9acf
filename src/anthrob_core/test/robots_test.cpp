#include "anthrob_core/robots.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <string>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace {

const std::string kConfig = ANTHROB_CONFIG_DIR;

/// Names are looked up in the robots of this workspace.
class NamedModels : public ::testing::Test {
 protected:
  void SetUp() override { setenv("ANTHROB_CONFIG", ANTHROB_CONFIG_DIR, 1); }
  void TearDown() override { unsetenv("ANTHROB_CONFIG"); }

  static std::string refusal_of(const std::string& robot, const std::string& model) {
    try {
      return find_model_file(robot, model) + " (accepted)";
    } catch (const BadInput& error) {
      return error.what();
    }
  }
};

TEST_F(NamedModels, AreOfTheRobotOrNameTheirs) {
  const std::string file = kConfig + "/anthrob/model_III.yaml";
  EXPECT_EQ(find_model_file("anthrob", "III"), file);
  EXPECT_EQ(find_model_file("III"), file);
  EXPECT_EQ(find_model_file("anthrob/III"), file);
  EXPECT_EQ(find_model_file("driven_axis", "anthrob/III"), file);
  EXPECT_EQ(find_model_file("driven_axis/I"), kConfig + "/driven_axis/model_I.yaml");
}

TEST_F(NamedModels, AreInAFolderGivenByItsPath) {
  const std::string file = kConfig + "/anthrob/model_III.yaml";
  EXPECT_EQ(find_model_file(kConfig + "/anthrob", "III"), file);
  EXPECT_EQ(find_model_file(kConfig + "/anthrob/III"), file);
}

TEST_F(NamedModels, AreFilesWhereThereIsOne) {
  const std::string file = kConfig + "/anthrob/model_III.yaml";
  EXPECT_EQ(find_model_file("no_such_robot", file), file);
  // What else is there is for the reader to refuse.
  EXPECT_EQ(find_model_file(kConfig + "/anthrob"), kConfig + "/anthrob");
  EXPECT_EQ(find_model_file("nowhere.yaml"), "nowhere.yaml");
}

TEST_F(NamedModels, SayWhatWasNotFound) {
  const std::string folder = kConfig + "/driven_axis";
  EXPECT_EQ(refusal_of("driven_axis", "II")
                .find("model II: no file " + folder + "/model_II.yaml; this robot has: "),
            0u);
  EXPECT_EQ(refusal_of(folder, "nowhere/model_I.yaml"),
            "model nowhere/model_I.yaml: no such file; expected an existing .yaml file, or a "
            "name such as II");
  EXPECT_EQ(refusal_of("nowhere/robot", "I"), "robot nowhere/robot: no such folder: nowhere/robot");
  EXPECT_EQ(refusal_of("anthrob", "nobody/I"),
            "robot nobody: no such folder: " + kConfig + "/nobody");
  EXPECT_EQ(refusal_of(kConfig, "I"), "model I: no file " + kConfig +
                                          "/model_I.yaml; expected a folder of a robot, with a "
                                          "file model_NAME.yaml");
}

TEST_F(NamedModels, AreFoundThroughROSElsewhere) {
  namespace fs = std::filesystem;
  unsetenv("ANTHROB_CONFIG");
  const fs::path packages = fs::temp_directory_path() / "anthrob_robots_test";
  fs::create_directories(packages / "anthrob_bringup");
  fs::remove(packages / "anthrob_bringup/config");
  fs::create_directory_symlink(kConfig, packages / "anthrob_bringup/config");
  for (const fs::path& place : {packages, packages / "anthrob_bringup"}) {
    setenv("ROS_PACKAGE_PATH", ("/nowhere:" + place.string()).c_str(), 1);
    EXPECT_EQ(find_model_file("II"), packages / "anthrob_bringup/config/anthrob/model_II.yaml");
  }
  setenv("ROS_PACKAGE_PATH", "/nowhere", 1);
  EXPECT_NE(refusal_of("anthrob", "II").find("the package anthrob_bringup is not found"),
            std::string::npos);
  fs::remove_all(packages);
}

}  // namespace
}  // namespace anthrob
