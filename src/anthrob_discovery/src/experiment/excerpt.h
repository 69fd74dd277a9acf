#pragma once

#include <Eigen/Core>
#include <vector>

#include "experiment/experiment.h"

namespace anthrob {
namespace discovery {

/// The first seconds of each recording, and where their bins are among those of the whole ones.
struct Excerpt {
  Experiments experiments;
  std::vector<Eigen::Index> rows;

  double duration() const { return total_duration(experiments); }  ///< [s]
  Eigen::VectorXf of(const Eigen::VectorXf& whole) const { return whole(rows); }
  /// Of a matrix with a row a bin, the rows of these bins and some of the columns.
  Eigen::MatrixXf of(const Eigen::MatrixXf& whole, const std::vector<Eigen::Index>& columns) const {
    return whole(rows, columns);
  }
};

/// Takes about the same length of every recording.
/// @param whole the recordings as experiments, in the same order   @param seconds in all
/// @param feed input that drives the replays, as of the whole ones
Excerpt excerpt(const RobotModel& model, const std::vector<Dataset>& recordings,
                const Experiments& whole, double seconds, const ExperimentOptions& options,
                std::optional<ReplayMode> feed = {});

}  // namespace discovery
}  // namespace anthrob
