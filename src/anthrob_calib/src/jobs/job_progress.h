#pragma once

#include <optional>
#include <string>

namespace anthrob {
namespace jobs {

/// How far a program is, by what it has told so far (anthrob_core's progress_lines.h).
struct JobProgress {
  std::string stage;
  double share = 0.0;                  ///< 0 to 1
  std::optional<double> seconds_left;  ///< [s]; none: not known
  std::string best;                    ///< the best that was found so far; empty: nothing yet
  std::optional<std::string> headline, error;
};

/// Reads lines of progress as they come, in pieces of any length.
class ProgressReader {
 public:
  void read(const std::string& piece);
  const JobProgress& progress() const { return progress_; }

 private:
  void read_line(const std::string& line);

  std::string rest_;  ///< a line that is not complete
  JobProgress progress_;
};

}  // namespace jobs
}  // namespace anthrob
