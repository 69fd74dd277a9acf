#pragma once

#include <CLI/CLI.hpp>
#include <fstream>
#include <functional>
#include <string>

namespace anthrob {
namespace mocap {
namespace tool {

/// Exit statuses of every command.
enum Exit { kDone = 0, kFailed = 1, kBadInput = 2, kInterrupted = 130 };

/// Parses the command line, runs `body`, and turns whatever goes wrong into one line on standard
/// error and the exit status of its kind.
int run(CLI::App& app, int argc, char** argv, const std::function<int()>& body);

/// A file that is written beside its place and moved there when it is whole.
class NewFile {
 public:
  /// @throws std::runtime_error naming the file
  explicit NewFile(const std::string& name);
  /// What was not put in place is removed.
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  std::ostream& stream() { return out_; }
  /// @throws std::runtime_error naming the file if it is not whole
  void close();
  /// After close(). @throws std::runtime_error naming the file
  void put_in_place();

 private:
  [[noreturn]] void fail() const;

  std::string name_, part_;
  std::ofstream out_;
};

/// Whether Ctrl-C was pressed. The first call starts listening.
bool interrupted();

}  // namespace tool
}  // namespace mocap
}  // namespace anthrob
