#pragma once

#include "optimiser/optimiser.h"

namespace anthrob {
namespace calibration {

/// The (mu, lambda) evolution strategy of section 5.1, Algorithm 5.1: comma selection, no
/// recombination, one self-adapting step size per variable (5.2), (5.3). Mutations out of bounds
/// are drawn again, invalid individuals are not selected, and the best individual ever is kept.
class EvolutionStrategy final : public Optimiser {
 public:
  explicit EvolutionStrategy(const OptimiserSettings& settings) : settings_(settings) {}
  SearchResult minimise(const std::vector<SearchVariable>& variables,
                        Evaluator& evaluator) const override;

 private:
  OptimiserSettings settings_;
};

}  // namespace calibration
}  // namespace anthrob
