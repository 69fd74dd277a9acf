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

/// A longer step for simulations of which only differences are used.
struct LongerStep {
  double times;       ///< the usual one
  double most_error;  ///< what it alone may change, rms of a channel [standard deviations]
};

/// @return the longer step [s]; 0 if its error is larger, or if it cannot simulate the model
double coarse_step(const Evaluator& evaluator, const Experiments& train, const Scales& scales,
                   const LongerStep& longer);

}  // namespace discovery
}  // namespace anthrob
