#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "anthrob_reference/arm.h"

namespace anthrob::virtual_robot {

/// Parses the command line, runs `body`, and turns whatever goes wrong into one line on standard
/// error and its exit status: 1 could not finish, 2 bad input.
int run_tool(CLI::App& app, int argc, char** argv, const std::function<void()>& body);

/// The arm of a model file. @throws BadInput with one line, whatever is wrong with the file
reference::ArmParameters load_arm(const std::string& file);

}  // namespace anthrob::virtual_robot
