#include "anthrob_sim/tool.h"

#include <ros/package.h>

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace tool {

std::string find_model_file(const std::string& robot, const std::string& model) {
  namespace fs = std::filesystem;
  if (fs::path(model).extension() == ".yaml" || model.find('/') != std::string::npos) {
    if (fs::is_regular_file(model)) return model;
    throw BadInput("--model " + model +
                   ": no such file; expected an existing .yaml file, or a name such as II");
  }
  fs::path folder;
  if (robot.find('/') != std::string::npos) {
    folder = robot;
  } else {
    const char* config = std::getenv("ANTHROB_CONFIG");
    const std::string bringup = config ? "" : ros::package::getPath("anthrob_bringup");
    if (!config && bringup.empty()) {
      throw BadInput(
          "--robot " + robot +
          ": the package anthrob_bringup is not found; source the workspace's setup.bash or set "
          "ANTHROB_CONFIG to the folder of robots");
    }
    folder = (config ? fs::path(config) : fs::path(bringup) / "config") / robot;
  }
  if (!fs::is_directory(folder)) {
    throw BadInput("--robot " + robot + ": no such folder: " + folder.string());
  }
  const fs::path file = folder / ("model_" + model + ".yaml");
  if (!fs::exists(file)) {
    std::string known;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string stem = entry.path().stem().string();
      if (stem.rfind("model_", 0) == 0) known += (known.empty() ? "" : ", ") + stem.substr(6);
    }
    throw BadInput("--model " + model + ": no file " + file.string() +
                   (known.empty() ? "; expected a folder of a robot, with a file model_NAME.yaml"
                                  : "; this robot has: " + known));
  }
  return file.string();
}

std::shared_ptr<const RobotModel> load_model(const CLI::App& app, const std::string& file,
                                             const LoadOptions& options) {
  auto model = load_robot_model(file, options);
  say(app, model->remarks);
  return model;
}

}  // namespace tool
}  // namespace anthrob
