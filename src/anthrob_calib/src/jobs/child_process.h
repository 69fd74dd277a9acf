#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace anthrob {
namespace jobs {

/// How a process ended.
struct ProcessEnd {
  int exit_code = 0;          ///< as a shell tells it: 128 and the signal if one killed it
  std::optional<int> signal;  ///< that killed it
};

/// A program that runs beside this one, in a process group of its own, without input, with
/// everything that it prints in a log file, and, if asked, with lower priority. It inherits no open
/// file.
///
/// It gets SIGINT, as by Ctrl-C, when this process ends, however that ends: the kernel sends it
/// when the thread that made this object ends. So that must be a thread that lives as long as the
/// process, and the destructor need not stop it.
class ChildProcess {
 public:
  static constexpr int kNiceness = 10;  ///< of `nice`'s default: robots' nodes go first

  /// @param command program, as a path, and its arguments
  /// @param log what is printed goes to the end of this file
  /// @param gives_way with lower priority
  /// @throws std::runtime_error with one line: the log cannot be written, the program not started
  ChildProcess(const std::vector<std::string>& command, const std::string& log,
               bool gives_way = true);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }
  /// What it has written on its progress since the last call. Does not wait.
  std::string read_progress();
  /// Does not wait. None: it runs.
  std::optional<ProcessEnd> end();
  /// SIGINT to its process group, as Ctrl-C does.
  void interrupt();

 private:
  pid_t pid_ = 0;
  int progress_ = 0;  ///< end of a pipe, to read
  std::optional<ProcessEnd> end_;
};

}  // namespace jobs
}  // namespace anthrob
