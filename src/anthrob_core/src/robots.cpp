#include "anthrob_core/robots.h"

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <sstream>

#include "anthrob_core/errors.h"
#include "require_file.h"

namespace anthrob {

namespace {

namespace fs = std::filesystem;

/// The folder of robots of this workspace, or of where it is installed: ROS lists packages, or
/// folders of packages.
std::optional<fs::path> folder_of_robots() {
  if (const char* chosen = std::getenv("ANTHROB_CONFIG")) return chosen;
  const char* packages = std::getenv("ROS_PACKAGE_PATH");
  std::istringstream places(packages ? packages : "");
  std::string place;
  while (std::getline(places, place, ':')) {
    const bool itself = fs::path(place).filename() == "anthrob_bringup";
    const fs::path config = (itself ? fs::path(place) : fs::path(place) / "anthrob_bringup");
    if (fs::is_directory(config / "config")) return config / "config";
  }
  return std::nullopt;
}

fs::path folder_of_robot(const std::string& robot) {
  fs::path folder = robot;
  if (robot.find('/') == std::string::npos) {
    const auto robots = folder_of_robots();
    if (!robots) {
      throw BadInput("robot " + robot +
                     ": the package anthrob_bringup is not found; source the workspace's "
                     "setup.bash or set ANTHROB_CONFIG to the folder of robots");
    }
    folder = *robots / robot;
  }
  if (!fs::is_directory(folder))
    throw BadInput("robot " + robot + ": no such folder: " + folder.string());
  return folder;
}

std::string named_model(const std::string& robot, const std::string& name) {
  const fs::path folder = folder_of_robot(robot);
  const fs::path file = folder / ("model_" + name + ".yaml");
  if (fs::exists(file)) return file.string();
  const std::string known = models_in(folder);
  throw BadInput("model " + name + ": no file " + file.string() +
                 (known.empty() ? "; expected a folder of a robot, with a file model_NAME.yaml"
                                : "; this robot has: " + known));
}

}  // namespace

std::string find_model_file(const std::string& robot, const std::string& model) {
  const std::size_t slash = model.rfind('/');
  const bool has_folder = slash != std::string::npos;
  if (fs::is_regular_file(model) || (has_folder && fs::exists(model))) return model;
  if (fs::path(model).extension() == ".yaml") {
    throw BadInput("model " + model +
                   ": no such file; expected an existing .yaml file, or a name such as II");
  }
  return has_folder ? named_model(model.substr(0, slash), model.substr(slash + 1))
                    : named_model(robot, model);
}

std::string find_model_file(const std::string& model) {
  const bool path = fs::path(model).extension() == ".yaml";
  return path ? model : find_model_file("anthrob", model);
}

}  // namespace anthrob
