#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "anthrob_core/config_node.h"

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

}  // namespace calibration
}  // namespace anthrob
