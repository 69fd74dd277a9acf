#pragma once

#include <memory>
#include <string>
#include <vector>

#include "anthrob_core/command_line.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {
namespace tool {

/// The model file that the options `--robot` and `--model` of a tool name.
/// @param robot name of a folder of robots, or with a '/' the path of the robot's folder. Names are
/// looked up under $ANTHROB_CONFIG, else under config/ of the package anthrob_bringup.
/// @param model name ("II" for model_II.yaml in the robot's folder), or the path of an existing
/// file (with a '/' or ending in .yaml); `robot` is then not used
/// @throws BadInput naming what was looked for and where
std::string find_model_file(const std::string& robot, const std::string& model);

/// Loads a model file. Prints the model's remarks (odd input that was used anyway) on standard
/// error, one line each.
std::shared_ptr<const RobotModel> load_model(const CLI::App& app, const std::string& file,
                                             const LoadOptions& options = {});

}  // namespace tool
}  // namespace anthrob
