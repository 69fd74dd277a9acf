#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace anthrob {
namespace tool {

/// Exit statuses of every command.
enum Exit { kDone = 0, kFailed = 1, kBadInput = 2, kInterrupted = 130 };

/// Parses the command line and runs `body`. Turns every error into one line on standard error and
/// an exit status. Ignores the arguments that roslaunch adds. Every command has --version.
/// @param stopped exit status if the program is stopped (signals.h) before it listens
int run(CLI::App& app, int argc, char** argv, const std::function<int()>& body,
        int stopped = kInterrupted);

/// Checks that an option is a number from `lowest` to `highest`. (CLI::Range accepts "nan".)
CLI::Validator within(double lowest, double highest);

/// For an option that takes a model file: also takes the name of a model (robots.h).
CLI::Validator model_or_file();

/// Whether the program was stopped (signals.h). The first call starts listening.
bool interrupted();

/// Prints remarks on input files on standard error, one line each.
void say(const CLI::App& app, const std::vector<std::string>& remarks);

/// Splits "a=1,2,3" into name and numbers. @throws BadInput for any other form
struct Assignment {
  std::string name;
  std::vector<double> values;
};
Assignment parse_assignment(const std::string& option, const std::string& text);

/// Splits "elbow=0:2:50" into name, ends and number of points.
/// @throws BadInput for any other form, or if the points are not 2 to kMostPoints
struct Range {
  std::string name;
  double from = 0.0, to = 0.0;
  int points = 0;
};
constexpr int kMostPoints = 100000;
Range parse_range(const std::string& option, const std::string& text);

/// Shows progress on standard error if that is a terminal: share done and time left.
class Progress {
 public:
  explicit Progress(const std::string& what);
  ~Progress();
  void update(double share);
  /// For work whose share done is not known: shows a text instead.
  void show(const std::string& state);
  double elapsed() const;  ///< [s]

 private:
  std::string what_;
  double start_, last_ = 0.0;
  bool visible_;
};

/// "37 %, 20 s left", or the time elapsed if the time left is not known. @param elapsed [s]
std::string progress_text(double share, double elapsed);

}  // namespace tool
}  // namespace anthrob
