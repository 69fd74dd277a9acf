#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "anthrob_core/config_node.h"
#include "optimiser/evaluator.h"

namespace anthrob {
namespace calibration {

struct OptimiserSettings {
  /// evolution_strategy | cmaes | sade | bee_colony | least_squares
  std::string method = "evolution_strategy";
  int parents = 6;        ///< mu; of the evolution strategy only
  int offspring = 36;     ///< lambda, or the size of the population
  int generations = 100;  ///< for least_squares: largest number of finite-difference Jacobians
  double target = 0.0;    ///< the evolution strategy stops at a fitness below that
  std::uint64_t seed = 1;

  /// The possible values of `method`.
  static const std::vector<std::string>& methods();
  /// @throws BadInput
  static OptimiserSettings read(const ConfigNode& node);
  /// @throws BadInput naming the setting that the method does not allow
  void check(const ConfigNode& node) const;
  /// Approximate number of evaluations, for the progress display.
  int evaluations(std::size_t variables) const;
};

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
