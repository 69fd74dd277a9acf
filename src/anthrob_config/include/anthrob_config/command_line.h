#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace anthrob {
namespace tool {

/// Exit statuses of every command.
enum Exit { kDone = 0, kFailed = 1, kBadInput = 2, kInterrupted = 130 };

/// Parses the command line and runs `body`. Turns every error into one line on standard error and
/// an exit status. Ignores the arguments that roslaunch adds.
int run(CLI::App& app, int argc, char** argv, const std::function<int()>& body);

/// Checks that an option is a number from `lowest` to `highest`. (CLI::Range accepts "nan".)
CLI::Validator within(double lowest, double highest);

/// Whether Ctrl-C was pressed, or SIGTERM came. The first call starts listening.
bool interrupted();

}  // namespace tool
}  // namespace anthrob
