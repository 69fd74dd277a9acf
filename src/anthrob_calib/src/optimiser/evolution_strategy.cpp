#include "optimiser/evolution_strategy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anthrob_core/random.h"

namespace anthrob {
namespace calibration {

namespace {

/// I_k of (5.1)
struct Individual {
  Point y;                ///< object parameters
  std::vector<double> s;  ///< strategy parameters: step sizes
  double fitness = std::numeric_limits<double>::infinity();
  bool valid = true;
};

bool fitter(const Individual& a, const Individual& b) {
  return a.fitness < b.fitness;
}

/// Random numbers of one individual: the n-th draw of (seed, generation, place) is always the same.
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint64_t individual) : random_(seed, individual) {}
  double normal() { return random_.normal(next_++); }

 private:
  CounterRandom random_;
  std::uint64_t next_ = 0;
};

/// (5.2)
void mutate_steps(std::vector<double>& s, Dice& dice) {
  const double n = static_cast<double>(s.size());
  const double common = std::exp(dice.normal() / std::sqrt(2.0 * n));
  for (double& step : s) step *= common * std::exp(dice.normal() / std::sqrt(2.0 * std::sqrt(n)));
}

/// (5.3), drawn again until it lies within bounds.
double mutate_value(double y, double step, const SearchVariable& variable, Dice& dice) {
  // A step that has grown far beyond the range would hardly ever hit it.
  constexpr int kDraws = 100000;
  for (int draw = 0; draw < kDraws; ++draw) {
    const double mutated = y + step * dice.normal();
    if (mutated >= variable.lower && mutated <= variable.upper) return mutated;
  }
  return y;
}

void mutate(Individual& individual, const std::vector<SearchVariable>& variables, Dice dice) {
  mutate_steps(individual.s, dice);
  for (std::size_t i = 0; i < variables.size(); ++i) {
    individual.y[i] = mutate_value(individual.y[i], individual.s[i], variables[i], dice);
  }
}

Individual ancestor(const std::vector<SearchVariable>& variables) {
  Individual a;
  for (const SearchVariable& v : variables) {
    a.y.push_back(v.initial);
    a.s.push_back(v.step);
  }
  return a;
}

void evaluate(std::vector<Individual>& population, Evaluator& evaluator) {
  std::vector<Point> points;
  for (const Individual& individual : population) points.push_back(individual.y);
  const std::vector<double> fitness = evaluator.fitness(points);
  for (std::size_t i = 0; i < population.size(); ++i) {
    population[i].fitness = fitness[i];
    population[i].valid = std::isfinite(fitness[i]);
  }
}

/// The best valid ones, at most `count`.
std::vector<Individual> select(std::vector<Individual> offspring, int count) {
  offspring.erase(std::remove_if(offspring.begin(), offspring.end(),
                                 [](const Individual& i) { return !i.valid; }),
                  offspring.end());
  std::stable_sort(offspring.begin(), offspring.end(), fitter);
  if (offspring.size() > static_cast<std::size_t>(count)) offspring.resize(count);
  return offspring;
}

}  // namespace

SearchResult EvolutionStrategy::minimise(const std::vector<SearchVariable>& variables,
                                         Evaluator& evaluator) const {
  Individual best = ancestor(variables);
  std::vector<Individual> parents(settings_.parents, best);
  for (int g = 0; g < settings_.generations; ++g) {
    std::vector<Individual> offspring;
    for (int k = 0; k < settings_.offspring; ++k) {
      offspring.push_back(parents[k % parents.size()]);
      const auto place = static_cast<std::uint64_t>(g) * settings_.offspring + k;
      mutate(offspring.back(), variables, Dice(settings_.seed, place));
    }
    evaluate(offspring, evaluator);
    for (const Individual& individual : offspring) {
      if (individual.valid && fitter(individual, best)) best = individual;
    }
    if (best.fitness < settings_.target) return {best.y, best.fitness, "target reached"};
    parents = select(std::move(offspring), settings_.parents);
    if (parents.empty()) return {best.y, best.fitness, "no valid individual left"};
  }
  return {best.y, best.fitness, "limit of generations reached"};
}

}  // namespace calibration
}  // namespace anthrob
