#pragma once

#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/excerpt.h"

namespace anthrob {
namespace discovery {

/// Recordings as experiments, with the same bins.
struct Laboratory {
  Experiments train, test, repeats;
  std::vector<long> lags;            ///< of each repeat behind the first of `train` [bins]
  std::vector<std::string> remarks;  ///< what is odd about the recordings
  /// What of `train` a first look at quick effects takes, and at slow ones.
  Excerpt quick, slow;
};

/// Lays out bins and refuses recordings that cannot answer, saying what is missing.
/// @throws BadInput with one line
Laboratory prepare(const Evaluator& evaluator, const Question& question);

/// A longer step that is good enough to tell how the differences change; 0 if there is none.
double coarse_step(const Evaluator& evaluator, const Experiments& train, const Scales& scales);

}  // namespace discovery
}  // namespace anthrob
