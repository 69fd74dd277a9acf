#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace anthrob {
namespace tool {

/// Exit statuses of every command.
enum Exit { kDone = 0, kFailed = 1, kBadInput = 2, kInterrupted = 130 };

/// Parses the command line, runs `body`, and turns whatever goes wrong into one line on standard
/// error and the exit status of its kind. What roslaunch adds to the command line is left out.
int run(CLI::App& app, int argc, char** argv, const std::function<int()>& body);

/// A check of an option: a number from `lowest` to `highest`. CLI::Range lets "nan" pass.
CLI::Validator within(double lowest, double highest);

/// Whether Ctrl-C was pressed, or SIGTERM came. The first call starts listening.
bool interrupted();

}  // namespace tool
}  // namespace anthrob
