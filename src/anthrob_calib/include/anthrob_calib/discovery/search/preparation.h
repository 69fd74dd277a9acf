#pragma once

#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/experiment/excerpt.h"

namespace anthrob {
namespace discovery {

/// Recordings as experiments, with the same bins.
struct PreparedRecordings {
  Question question;  ///< as it was asked, without the columns that are left out
  Experiments train, test, repeats;
  std::vector<long> lags;  ///< by how much each repeat is behind the first of `train` [bins]
  std::vector<std::string> remarks;  ///< what is odd about the recordings
  /// The parts of `train` along which doses of quick and of slow effects are simulated.
  Excerpt quick, slow;
};

/// Chooses the bins, makes experiments of the recordings, and refuses recordings that cannot
/// answer.
/// @throws BadInput with one line that says what is wrong with which recording
PreparedRecordings prepare(const Evaluator& evaluator, const Question& question);

/// A longer step of the simulation with which changes of the residual are exact enough [s]; 0:
/// none.
double coarse_step(const Evaluator& evaluator, const Experiments& train, const Scales& scales);

}  // namespace discovery
}  // namespace anthrob
