#pragma once

#include <string>
#include <vector>

#include "experiment/evaluator.h"
#include "experiment/excerpt.h"
#include "question/question.h"

namespace anthrob {
namespace discovery {

/// What was admitted: recordings as experiments, with the same bins.
struct Admission {
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
Admission admit(const Evaluator& evaluator, const Question& question);

}  // namespace discovery
}  // namespace anthrob
