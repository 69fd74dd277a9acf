#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "anthrob_calib/discovery/fit/convergence.h"
#include "anthrob_calib/discovery/fit/reduction.h"
#include "anthrob_calib/discovery/search/candidate_comparison.h"

namespace anthrob {
namespace discovery {

/// The objects that every decision of the search needs.
struct SearchContext {
  const Evaluator& evaluator;
  const ModelFit &train, &test;
  const std::vector<Candidate>& candidates;
  const CandidateComparison& comparison;
  const Convergence& convergence;

  /// A fit and its residual on held-out recordings.
  Tested tested(Fitted fit) const {
    Eigen::VectorXf residual = test.residual(fit.variant);
    return {std::move(fit), std::move(residual)};
  }
  /// The fit without the effect at that index; see without_effect().
  std::optional<Fitted> without(std::size_t effect, std::size_t candidate,
                                const Fitted& fit) const {
    return without_effect(evaluator, train, fit, effect, candidates[candidate]);
  }
};

}  // namespace discovery
}  // namespace anthrob
