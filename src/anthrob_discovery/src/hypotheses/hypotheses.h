#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "admission/admission.h"
#include "experiment/noise_floor.h"
#include "fit/candidate.h"
#include "fit/convergence.h"
#include "fit/model_fit.h"
#include "hypotheses/candidate_comparison.h"
#include "judgement/judge.h"

namespace anthrob {
namespace discovery {

/// What is weighed: the candidates, how a model with some of them is fitted, and by what it is
/// judged. The members refer to each other.
struct Hypotheses {
  /// @param train, test, scan fits to the training recordings, to the held-out ones, and to the
  /// training recordings with differences by a longer step, for trials of many sizes
  /// @param scales noise floors by channel   @param seed of resampling
  Hypotheses(const Evaluator& evaluator, std::vector<Candidate> candidates, ModelFit train,
             ModelFit test, ModelFit scan, const Scales& scales, const Options& options,
             std::uint64_t seed);
  Hypotheses(const Hypotheses&) = delete;
  Hypotheses& operator=(const Hypotheses&) = delete;

  /// A fit and its residual on held-out recordings.
  Tested tested(Fitted fit) const;
  /// The fit without the effect at that index; see without_effect().
  std::optional<Fitted> without(std::size_t effect, std::size_t candidate, const Fitted& fit) const;

  const Evaluator& evaluator;
  const Options options;
  const std::vector<Candidate> candidates;
  const ModelFit train, test;
  const ModelFit scan;
  const Judge train_judge, test_judge;
  const Convergence convergence;
  const CandidateComparison comparison;
};

/// Candidates, to be weighed by what was admitted.
Hypotheses pose(const Evaluator& evaluator, std::vector<Candidate> candidates,
                const Admission& admission, const Scales& scales);

}  // namespace discovery
}  // namespace anthrob
