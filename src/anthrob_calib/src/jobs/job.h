#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "jobs/child_process.h"
#include "jobs/job_command.h"
#include "jobs/job_progress.h"

namespace anthrob {
namespace jobs {

/// What became of a job.
struct JobResult {
  bool success = false;
  bool interrupted = false;        ///< on request; the same order goes on from there
  std::string headline;            ///< the verdict, or what went wrong
  std::vector<std::string> files;  ///< that it wrote for people, as whole paths
  std::string log;                 ///< file with all that it printed
  int exit_code = 0;               ///< 128 and the signal if one killed it
  std::string error;               ///< the last line of what it complained of; empty: nothing
};

/// A program at work, from its start to its result. Takes no time: update() looks.
class Job {
 public:
  /// Starts the program (ChildProcess tells from which thread). Its log is PROGRAM.log in the
  /// folder `out`, which is made if need be; earlier logs stay, above.
  /// @throws std::runtime_error with one line: the folder or the log cannot be written, the program
  /// is not installed or cannot be started
  explicit Job(const JobCommand& command);

  /// @return the result once the program has ended
  std::optional<JobResult> update();
  const JobProgress& progress() const { return reader_.progress(); }
  pid_t pid() const { return process_.pid(); }
  /// As Ctrl-C: the program keeps what it has, and ends.
  void interrupt();

 private:
  using Times = std::map<std::string, std::filesystem::file_time_type>;

  Times written() const;
  JobResult result_of(const ProcessEnd& end) const;
  std::string last_line() const;

  std::string out_, log_;
  Times before_;
  std::uintmax_t log_begin_ = 0;  ///< of this job [bytes]
  ProgressReader reader_;
  ChildProcess process_;
  bool commands_robot_ = false;
  bool interrupted_ = false;
};

}  // namespace jobs
}  // namespace anthrob
