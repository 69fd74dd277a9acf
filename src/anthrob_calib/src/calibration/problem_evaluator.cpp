#include "calibration/problem_evaluator.h"

#include <tbb/parallel_for.h>

namespace anthrob {
namespace calibration {

std::vector<double> ProblemEvaluator::fitness(const std::vector<Point>& points) {
  std::vector<double> fitness(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t i) { fitness[i] = problem_.fitness(points[i]); });
  return fitness;
}

std::vector<std::vector<double>> ProblemEvaluator::residuals(const std::vector<Point>& points) {
  std::vector<std::vector<double>> residuals(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t i) { residuals[i] = problem_.residuals(points[i]); });
  return residuals;
}

std::vector<SearchVariable> search_variables(const ParameterSpace& space) {
  std::vector<SearchVariable> variables;
  for (const ModelParameter& p : space.parameters()) {
    variables.push_back({p.initial, p.lower, p.upper, p.step});
  }
  return variables;
}

}  // namespace calibration
}  // namespace anthrob
