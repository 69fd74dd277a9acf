#include "anthrob_virtual_robot/tool.h"

#include <exception>
#include <iostream>
#include <stdexcept>

#include "anthrob_config/errors.h"

namespace anthrob::virtual_robot {
namespace {

constexpr int kFailed = 1;
constexpr int kBadInput = 2;

int complain(const std::string& what, int status) {
  std::cerr << what << "\n";
  return status;
}

}  // namespace

int run_tool(CLI::App& app, int argc, char** argv, const std::function<void()>& body) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    return complain(app.get_name() + ": " + error.what(), kBadInput);
  }
  try {
    body();
    return 0;
  } catch (const BadInput& error) {
    return complain(error.what(), kBadInput);
  } catch (const std::invalid_argument& error) {
    return complain(app.get_name() + ": " + error.what(), kBadInput);
  } catch (const std::exception& error) {
    return complain(app.get_name() + ": " + error.what(), kFailed);
  }
}

reference::ArmParameters load_arm(const std::string& file) {
  try {
    return reference::Arm::load(file);
  } catch (const std::exception& error) {
    throw BadInput(error.what());
  }
}

}  // namespace anthrob::virtual_robot
