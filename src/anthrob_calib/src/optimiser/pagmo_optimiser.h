#pragma once

#include "optimiser/optimiser.h"

namespace anthrob {
namespace calibration {

/// CMA-ES, self-adaptive differential evolution or artificial bee colony from pagmo. They search in
/// units of the steps, within the bounds and at most kReach steps from the start, and ask for one
/// point at a time: threads share the runs of a point instead of points.
class PagmoOptimiser final : public Optimiser {
 public:
  static constexpr double kReach = 10.0;

  explicit PagmoOptimiser(const OptimiserSettings& settings) : settings_(settings) {}
  SearchResult minimise(const std::vector<SearchVariable>& variables,
                        Evaluator& evaluator) const override;

 private:
  OptimiserSettings settings_;
};

}  // namespace calibration
}  // namespace anthrob
