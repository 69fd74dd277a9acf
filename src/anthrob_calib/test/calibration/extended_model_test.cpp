// Model files that extend another.
#include "anthrob_calib/calibration/extended_model.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "problem/parameter_space.h"
#include "two_muscle_rig.h"

namespace anthrob {
namespace calibration {
namespace {

TEST(ExtendedModel, ReadsBackAsTheSameRobot) {
  const std::string folder =
      (std::filesystem::temp_directory_path() / ("extended_" + std::to_string(getpid()))).string();
  std::filesystem::create_directories(folder);
  for (const char* name : {"/two_muscle_rig/model_II.yaml", "/anthrob/model_III_tier1.yaml"}) {
    const std::string base = ANTHROB_CONFIG_DIR + std::string(name);
    const bool rig_model = base.find("rig") != std::string::npos;
    const std::map<std::string, double> overrides =
        rig_model ? std::map<std::string, double>{{"muscles.flexor.path.2.cylinder.radius", 0.0171},
                                                  {"muscles.extensor.spindle_radius", 0.00677},
                                                  {"joints.hinge.friction.viscous", 0.0213}}
                  : std::map<std::string, double>{
                        {"muscles.posterior_deltoid.path.3.mesh.offset.1", 0.0003}};
    const ConfigNode model = ConfigNode::load(base);
    std::ofstream(folder + "/model.yaml")
        << extended_model_text(model, base, overrides, folder, "By a test.");
    const ConfigNode extended = ConfigNode::load(folder + "/model.yaml");
    for (const auto& [path, value] : overrides) EXPECT_EQ(number_at(extended, path), value) << path;
    EXPECT_NO_THROW(build_robot_model(extended));
  }
  std::filesystem::remove_all(folder);
}

TEST(ExtendedModel, NamesFilesWhateverTheirFoldersAreCalled) {
  namespace fs = std::filesystem;
  const fs::path root = fs::temp_directory_path() / ("named_" + std::to_string(getpid()));
  for (const char* name : {"run #2: a", "[one], 'two' & \"three\"", "back\\slash", "- {x}"}) {
    const fs::path robot = root / name;
    fs::create_directories(robot);
    fs::copy(ANTHROB_CONFIG_DIR "/anthrob", robot, fs::copy_options::recursive);
    const std::string base = (robot / "model_III_tier1.yaml").string();
    fs::create_directories(root / "out");
    const std::string file = (root / "out/model.yaml").string();
    std::ofstream(file) << extended_model_text(
        ConfigNode::load(base), base, {{"muscles.posterior_deltoid.path.3.mesh.offset.1", 0.0003}},
        (root / "out").string(), "By a test.");
    EXPECT_NO_THROW(load_robot_model(file)) << name;
    fs::remove_all(root);
  }
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
