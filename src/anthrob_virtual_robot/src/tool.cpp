#include "tool.h"

#include <stdexcept>

#include "anthrob_core/errors.h"

namespace anthrob::virtual_robot {

int run_tool(CLI::App& app, int argc, char** argv, const std::function<void()>& body) {
  return tool::run(app, argc, argv, [&] {
    try {
      body();
    } catch (const std::invalid_argument& error) {
      throw BadInput(error.what());
    }
    return tool::kDone;
  });
}

reference::ArmParameters load_arm(const std::string& file) {
  try {
    return reference::Arm::load(file);
  } catch (const std::exception& error) {
    throw BadInput(error.what());
  }
}

}  // namespace anthrob::virtual_robot
