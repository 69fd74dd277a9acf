#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "anthrob_calib/hosts/mpi_session.h"
#include "anthrob_core/parameter_list.h"
#include "anthrob_sim/model/robot_model.h"
#include "experiment/experiment.h"
#include "experiment/journal.h"

namespace anthrob {
namespace discovery {

/// A model as it might be: the given one with its ordinary parameters moved and effects added.
struct Variant {
  std::vector<double> nuisances;  ///< values of Evaluator::nuisances(), or empty: as given
  std::vector<EffectInstance> effects = {};
  double step = 0.0;  ///< of the simulation [s]; 0: as usual
  /// Counts of the sensors of motor positions [rad] and forces [N], which controllers pass on.
  double position_count = 0.0, force_count = 0.0;
};

/// Differences of all experiments, one after the other; empty if the variant cannot be built or
/// simulated.
using Differences = Eigen::VectorXf;

/// Progress of the variants that are compared together.
struct Batch {
  std::size_t done = 0, size = 0;
  double elapsed = 0.0;  ///< since it was begun [s]
};

/// Thrown when the user interrupts the work.
class Interrupted : public std::exception {};

/// Compares variants of a model with experiments, on many threads and perhaps hosts. The results do
/// not depend on their number.
class Evaluator {
 public:
  /// @param model_file, nuisances as read for it
  Evaluator(const std::string& model_file, std::vector<ModelParameter> nuisances, double step,
            int jobs);

  const std::shared_ptr<const RobotModel>& model() const { return plain_; }
  const RobotDescription& description() const { return description_; }
  const std::vector<ModelParameter>& nuisances() const { return nuisances_; }
  std::vector<double> initial_nuisances() const;

  /// @param progress called when one more of a batch is done; returns false to stop
  void on_progress(std::function<bool(const Batch&)> progress) { progress_ = std::move(progress); }

  /// Opens a journal file: results that are in it are not simulated again. It is only valid for
  /// this program, this model and these ordinary parameters; otherwise it is started again.
  /// @param program resume::program_fingerprint(), from before MPI loaded libraries
  Journal& keep_journal(const std::string& file, std::uint64_t program);
  /// Variants that are compared together are shared among the processes, all of which must compare
  /// the same. Only that of rank 0 keeps a journal. @param session outlives this object
  void share_with(const hosts::MpiSession& session) { session_ = &session; }
  std::size_t simulated() const { return simulated_; }  ///< variants, so far

  /// @return one result for each variant. @throws Interrupted
  std::vector<Differences> compare(
      const std::vector<Variant>& variants,
      const std::vector<std::shared_ptr<const Experiment>>& experiments) const;

  /// Runs `count` independent pieces of work, as many at a time as there are threads. Rethrows what
  /// they throw. Where several processes share the variants, work must not compare any: see
  /// fit_side_by_side().
  void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work) const;

  /// The same of work that compares variants. Several processes do one piece after the other, so
  /// that all compare in the same order, and share the variants of each.
  void fit_side_by_side(std::size_t count, const std::function<void(std::size_t)>& work) const;

  /// @param known numbers of the model file that are not `variant`'s to choose, by key path
  /// @throws BadInput if it cannot be built
  std::shared_ptr<const RobotModel> build(const Variant& variant,
                                          const std::map<std::string, double>& known = {}) const;
  /// @throws BadInput if the robot of a recording cannot be built: see build_recorded()
  void require_buildable(const Dataset& recording) const;

 private:
  bool is_shared() const { return session_ != nullptr && session_->size() > 1; }
  Differences simulate(const Variant& variant,
                       const std::vector<std::shared_ptr<const Experiment>>& experiments) const;
  Differences known_or_simulated(
      const Variant& variant,
      const std::vector<std::shared_ptr<const Experiment>>& experiments) const;
  std::vector<Differences> compare_here(
      const std::vector<Variant>& variants,
      const std::vector<std::shared_ptr<const Experiment>>& experiments) const;
  std::vector<Differences> compare_everywhere(
      const std::vector<Variant>& variants,
      const std::vector<std::shared_ptr<const Experiment>>& experiments) const;

  RobotDescription description_;
  std::vector<ModelParameter> nuisances_;
  double step_;
  int jobs_;
  std::shared_ptr<const RobotModel> plain_;
  std::function<bool(const Batch&)> progress_;
  mutable std::mutex progress_mutex_;
  std::unique_ptr<Journal> journal_;
  const hosts::MpiSession* session_ = nullptr;
  mutable std::atomic<std::size_t> simulated_{0};
};

/// Length of all experiments' differences together.
std::size_t total_size(const std::vector<std::shared_ptr<const Experiment>>& experiments);

}  // namespace discovery
}  // namespace anthrob
