#pragma once

#include <memory>
#include <string>
#include <vector>

#include "anthrob_core/command_line.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {
namespace tool {

/// Loads a model file. Prints the model's remarks (odd input that was used anyway) on standard
/// error, one line each.
std::shared_ptr<const RobotModel> load_model(const CLI::App& app, const std::string& file,
                                             const LoadOptions& options = {});

}  // namespace tool
}  // namespace anthrob
