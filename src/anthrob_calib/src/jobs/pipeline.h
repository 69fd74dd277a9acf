#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_core/files.h"
#include "jobs/job_command.h"

namespace anthrob {
namespace jobs {

/// A stage of a calibration as in section 8.1 of the thesis: what is fitted to which recordings.
struct Stage {
  std::string name;  ///< of its folder
  std::string config, data, validation;
  std::vector<std::string> options;  ///< of anthrob_calibrate, word by word
};

/// Stages, one after the other, from a file; its paths are relative to it.
/// @throws BadInput with one line
std::vector<Stage> load_stages(const std::string& file);

/// All files that the runs of stages read, but recordings: configurations, models, what these
/// extend.
/// @throws BadInput if one is missing
std::vector<std::string> files_of(const std::vector<Stage>& stages);

/// A run of a stage that is over.
struct FinishedRun {
  std::uint64_t seed = 0;
  std::string result;  ///< its result.json
  std::string headline;
  double before = 0.0, after = 0.0;  ///< fitness

  /// @throws std::runtime_error if there is no such file, or it has no fitness
  static FinishedRun read(std::uint64_t seed, const std::string& result,
                          const std::string& headline);
};

/// Each stage is searched twice, so that one local minimum does less harm, and the next stage
/// starts from the better one. Knows what is to be run and what came out, and runs nothing.
class Pipeline {
 public:
  static constexpr std::size_t kRuns = 2;  ///< of a stage, as in section 8.1

  /// @param out folder for all stages, a whole path   @param seed of the first run of each stage;
  /// the second has the next one   @param jobs threads; 0: all
  Pipeline(std::vector<Stage> stages, const std::string& out, std::uint64_t seed,
           std::int64_t jobs);

  /// Name of the run that comes next: "tier1_statics, seed 2". None: all are done.
  std::optional<std::string> name() const;
  /// Its command; continues it if it was interrupted. @throws BadInput
  JobCommand command() const;
  /// The run is over.
  void finish(const std::string& headline);
  /// Share of all runs that is done. @param of_run share of the present one
  double share(double of_run) const;

  /// Once all are done: the verdict of the last stage, and which ones before it have doubts.
  std::string headline() const;
  /// Once all are done: model.yaml, which extends the model that was kept last, and pipeline.json,
  /// which says where its numbers come from.
  OutputFiles files() const;
  /// A line for the terminal on the run that was finished last.
  std::string summary() const;

 private:
  const Stage& stage() const { return stages_[finished_.size() - 1]; }
  std::uint64_t seed() const { return seed_ + finished_.back().size(); }
  std::string folder() const;

  std::vector<Stage> stages_;
  std::string out_;
  std::uint64_t seed_;
  std::int64_t jobs_;
  std::vector<std::vector<FinishedRun>> finished_;  ///< by stage; the last one is at work
};

/// The better one, by the fitness at its end; the first of equals.
const FinishedRun& better(const std::vector<FinishedRun>& runs);

}  // namespace jobs
}  // namespace anthrob
