#pragma once

#include <memory>
#include <string>
#include <vector>

#include "optimiser/evaluator.h"
#include "optimiser/optimiser_settings.h"

namespace anthrob {
namespace calibration {

struct SearchResult {
  Point best;
  double fitness = 0.0;  ///< infinite if no point was valid
  std::string reason;    ///< why it stopped
  /// Largest norm of the derivative of all residuals for each variable, per step; empty for methods
  /// without derivatives.
  std::vector<double> sensitivity = {};
};

/// A search method. Deterministic: the same variables, seed and fitnesses give the same points.
class Optimiser {
 public:
  virtual ~Optimiser() = default;
  virtual SearchResult minimise(const std::vector<SearchVariable>& variables,
                                Evaluator& evaluator) const = 0;
};

std::unique_ptr<Optimiser> make_optimiser(const OptimiserSettings& settings);

}  // namespace calibration
}  // namespace anthrob
