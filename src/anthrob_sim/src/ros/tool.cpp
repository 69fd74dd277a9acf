#include "anthrob_sim/tool.h"

namespace anthrob {
namespace tool {

std::shared_ptr<const RobotModel> load_model(const CLI::App& app, const std::string& file,
                                             const LoadOptions& options) {
  auto model = load_robot_model(file, options);
  say(app, model->remarks);
  return model;
}

}  // namespace tool
}  // namespace anthrob
