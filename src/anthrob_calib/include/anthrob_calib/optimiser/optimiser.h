#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "anthrob_calib/optimiser/evaluator.h"
#include "anthrob_sim/model/config_node.h"

namespace anthrob {
namespace calibration {

struct OptimiserSettings {
  /// evolution_strategy | cmaes | sade | bee_colony | least_squares
  std::string method = "evolution_strategy";
  int parents = 6;     ///< mu; of the evolution strategy only
  int offspring = 36;  ///< lambda, or the size of the population
  int generations = 100;
  double target = 0.0;  ///< the evolution strategy stops at a fitness below that
  std::uint64_t seed = 1;

  /// @throws BadInput
  /// What `method` may be.
  static const std::vector<std::string>& methods();
  static OptimiserSettings read(const ConfigNode& node);
  /// @throws BadInput naming what does not fit the method
  void check(const ConfigNode& node) const;
  /// Evaluations, about: for progress.
  int evaluations(std::size_t variables) const;
};

struct SearchResult {
  Point best;
  double fitness = 0.0;  ///< infinite if no point was valid
  std::string reason;    ///< why it stopped
  /// By how much all residuals together change with a step of each variable, where that is most;
  /// empty for methods without derivatives.
  std::vector<double> sensitivity = {};
};

/// A way to search. Deterministic: the same variables, seed and fitnesses give the same points.
class Optimiser {
 public:
  virtual ~Optimiser() = default;
  virtual SearchResult minimise(const std::vector<SearchVariable>& variables,
                                Evaluator& evaluator) const = 0;
};

std::unique_ptr<Optimiser> make_optimiser(const OptimiserSettings& settings);

}  // namespace calibration
}  // namespace anthrob
