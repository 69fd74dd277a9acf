#pragma once

#include <functional>
#include <string>

#include "anthrob_core/command_line.h"
#include "anthrob_reference/arm.h"

namespace anthrob::virtual_robot {

/// As tool::run; std::invalid_argument (for example an unknown law or place) counts as bad input,
/// too.
int run_tool(CLI::App& app, int argc, char** argv, const std::function<void()>& body);

/// The arm of a model file. @throws BadInput with one line for any error in the file
reference::ArmParameters load_arm(const std::string& file);

}  // namespace anthrob::virtual_robot
