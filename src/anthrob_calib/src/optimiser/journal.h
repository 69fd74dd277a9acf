#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_calib/resume/result_file.h"
#include "anthrob_core/folder_lock.h"
#include "optimiser/evaluator.h"

namespace anthrob {
namespace calibration {

/// Thrown out of a search that the user interrupts.
struct Interrupted {};

/// One batch of evaluations in the history of a search.
struct Generation {
  int evaluations = 0;  ///< so far
  int valid = 0;        ///< of this batch
  double best = 0.0;    ///< of this batch
  double mean = 0.0;    ///< of the valid ones of this batch
  double best_ever = 0.0;
  std::vector<double> fitness;  ///< of this batch, in order
};

/// Stands between an optimiser and the evaluator: keeps the best point and the history, and stores
/// every fitness in a file. After an interruption the optimiser starts again from the beginning;
/// the evaluations that the journal already has come from there. So any optimiser resumes to the
/// same result, to the last bit. Evaluations of another build of the program may differ; they are
/// repeated. Residuals are stored in a separate file beside the journal until forget_residuals().
///
/// Every line of the file ends in a checksum of it and of all lines before, because a changed
/// fitness would lead the search astray in silence.
class Journal final : public Evaluator {
 public:
  struct Options {
    std::string file;         ///< of the journal; empty: none is kept
    std::string fingerprint;  ///< of everything that the numbers depend on
    bool resume = false;      ///< false: replaces an existing journal
    int batch = 36;           ///< that many single evaluations are one entry of the history
    double patience = 2.0;    ///< [s] at most between two writings, if evaluations are shorter
    std::function<bool()> stop = {};
    std::function<void(int)> progress = {};  ///< gets the number of evaluations
    std::uint64_t program = 0;               ///< fingerprint of the build that calculates them
  };

  /// @throws BadInput if there is nothing to resume, it belongs to something else or is damaged
  /// before its last line, or another run writes into the same folder
  Journal(Evaluator& evaluator, Options options);

  std::vector<double> fitness(const std::vector<Point>& points) override;
  std::vector<std::vector<double>> residuals(const std::vector<Point>& points) override;
  /// Writes what has not been written yet.
  void save();
  /// Deletes the file of residuals, once everything has been computed from them.
  void forget_residuals() {
    if (lists_) lists_->remove();
  }

  const Point& best() const { return best_; }
  double best_fitness() const { return best_fitness_; }
  int evaluations() const { return evaluations_; }
  int replayed() const { return replayed_; }  ///< evaluations taken from the journal
  /// Whether the journal to resume was written by another build of the program.
  bool outdated() const { return outdated_; }
  /// What is odd about the journal to resume; none if nothing.
  const std::optional<std::string>& remark() const { return remark_; }
  std::vector<Generation> history() const;

 private:
  struct Entry {
    std::uint64_t point;  ///< fingerprint
    double fitness;
  };

  void load();
  void read_entries(const std::vector<std::string>& lines);
  void write() const;
  void open_lists();
  void check_stop() const;
  void note(const Point& point, double fitness);
  Generation generation_so_far() const;  ///< the one that is not complete
  void close_generation();

  Evaluator& evaluator_;
  Options options_;
  std::unique_ptr<FolderLock> lock_;
  std::vector<Entry> entries_;                         ///< of the file
  std::unique_ptr<resume::ResultFile<double>> lists_;  ///< of residuals, by points
  std::size_t unsaved_ = 0;
  std::chrono::steady_clock::time_point saved_at_ = std::chrono::steady_clock::now();
  bool outdated_ = false;
  std::optional<std::string> remark_;
  int evaluations_ = 0, replayed_ = 0;
  Point best_;
  double best_fitness_;
  Generation open_;
  double open_sum_ = 0.0;
  int open_count_ = 0;
  std::vector<Generation> history_;
};

}  // namespace calibration
}  // namespace anthrob
