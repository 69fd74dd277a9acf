#include "optimiser/optimiser_settings.h"

#include <algorithm>

namespace anthrob {
namespace calibration {

OptimiserSettings OptimiserSettings::read(const ConfigNode& node) {
  OptimiserSettings s;
  s.method = node.text("method");
  s.generations = node.at("generations").as_integer(1, 1000000);
  if (node.has("parents")) s.parents = node.at("parents").as_integer(1, 100000);
  if (node.has("offspring")) s.offspring = node.at("offspring").as_integer(1, 100000);
  s.target = node.number_or("target", s.target, Bounds::nonnegative(), "1");
  if (node.has("seed")) {
    s.seed = static_cast<std::uint64_t>(node.at("seed").as_integer(0, 2147483647));
  }
  s.check(node);
  return s;
}

const std::vector<std::string>& OptimiserSettings::methods() {
  static const std::vector<std::string> kMethods = {"evolution_strategy", "cmaes", "sade",
                                                    "bee_colony", "least_squares"};
  return kMethods;
}

void OptimiserSettings::check(const ConfigNode& node) const {
  if (std::find(methods().begin(), methods().end(), method) == methods().end()) {
    node.at("method").fail(
        method + ": expected evolution_strategy, cmaes, sade, bee_colony or least_squares");
  }
  if (method == "evolution_strategy" && parents > offspring) {
    node.at("parents").fail_expected("at most as many parents as offspring");
  }
  if (method != "evolution_strategy" && target > 0.0) {
    node.at("target").fail_expected("0: only evolution_strategy stops at a target fitness");
  }
  if ((method == "cmaes" || method == "sade" || method == "bee_colony") && offspring < 7) {
    node.fail("offspring: " + std::to_string(offspring) + ": expected at least 7 for " + method);
  }
}

int OptimiserSettings::evaluations(std::size_t variables) const {
  // With secants, and what it looks at from where it has converged: more than are used as a rule.
  if (method == "least_squares") return (generations + 5) * (static_cast<int>(variables) + 2);
  return generations * offspring;
}

}  // namespace calibration
}  // namespace anthrob
