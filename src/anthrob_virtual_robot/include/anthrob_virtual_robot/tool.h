#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace anthrob::virtual_robot {

/// Parses the command line, runs `body`, and turns whatever goes wrong into one line on standard
/// error and its exit status: 1 could not finish, 2 bad input.
int run_tool(CLI::App& app, int argc, char** argv, const std::function<void()>& body);

}  // namespace anthrob::virtual_robot
