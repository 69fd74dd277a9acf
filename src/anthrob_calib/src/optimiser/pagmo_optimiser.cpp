#include "optimiser/pagmo_optimiser.h"

#include <algorithm>
#include <cmath>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/bee_colony.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/sade.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "anthrob_core/random.h"

namespace anthrob {
namespace calibration {

namespace {

/// pagmo knows no invalid points, and no infinity: something worse than anything.
constexpr double kInvalid = 1e10;

/// The search as pagmo sees it: variables in steps from their start.
struct ScaledProblem {
  Evaluator* evaluator = nullptr;
  const std::vector<SearchVariable>* variables = nullptr;

  Point unscaled(const pagmo::vector_double& z) const {
    Point point;
    for (std::size_t i = 0; i < z.size(); ++i) {
      const SearchVariable& v = (*variables)[i];
      point.push_back(std::clamp(v.initial + z[i] * v.step, v.lower, v.upper));
    }
    return point;
  }

  pagmo::vector_double fitness(const pagmo::vector_double& z) const {
    const double value = evaluator->fitness({unscaled(z)}).front();
    return {std::isfinite(value) ? value : kInvalid};
  }

  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    pagmo::vector_double lower, upper;
    for (const SearchVariable& v : *variables) {
      lower.push_back(std::max((v.lower - v.initial) / v.step, -PagmoOptimiser::kReach));
      upper.push_back(std::min((v.upper - v.initial) / v.step, PagmoOptimiser::kReach));
    }
    return {lower, upper};
  }

  template <class Archive>
  void serialize(Archive&, unsigned) {}  // never sent anywhere
};

pagmo::algorithm make_algorithm(const OptimiserSettings& settings) {
  const auto generations = static_cast<unsigned>(settings.generations);
  const auto seed = static_cast<unsigned>(settings.seed);
  pagmo::algorithm algorithm;
  if (settings.method == "sade") {
    algorithm = pagmo::algorithm(pagmo::sade(generations, 2u, 1u, 0.0, 0.0, false, seed));
  } else if (settings.method == "bee_colony") {
    // A generation of bees asks for two points a bee, or a little more.
    algorithm = pagmo::algorithm(pagmo::bee_colony(std::max(1u, generations / 2), 20u, seed));
  } else {
    // Its first step is a share of the box, which is 2 kReach wide: one step of ours.
    algorithm = pagmo::algorithm(pagmo::cmaes(
        generations, -1, -1, -1, -1, 0.5 / PagmoOptimiser::kReach, 0.0, 0.0, false, true, seed));
  }
  return algorithm;
}

/// The start, and points about it.
pagmo::population first_population(const pagmo::problem& problem,
                                   const OptimiserSettings& settings) {
  pagmo::population population(problem, 0u, static_cast<unsigned>(settings.seed));
  const auto [lower, upper] = problem.get_bounds();
  for (int k = 0; k < settings.offspring; ++k) {
    const CounterRandom random(settings.seed, static_cast<std::uint64_t>(k));
    pagmo::vector_double z(lower.size(), 0.0);
    for (std::size_t i = 0; k > 0 && i < z.size(); ++i) {
      z[i] = std::clamp(random.normal(i), lower[i], upper[i]);
    }
    population.push_back(z);
  }
  return population;
}

}  // namespace

SearchResult PagmoOptimiser::minimise(const std::vector<SearchVariable>& variables,
                                      Evaluator& evaluator) const {
  const ScaledProblem scaled{&evaluator, &variables};
  const pagmo::problem problem{scaled};
  pagmo::population population = first_population(problem, settings_);
  population = make_algorithm(settings_).evolve(population);
  const double fitness = population.champion_f().front();
  return {scaled.unscaled(population.champion_x()), fitness < kInvalid ? fitness : HUGE_VAL,
          "limit of generations reached"};
}

}  // namespace calibration
}  // namespace anthrob
