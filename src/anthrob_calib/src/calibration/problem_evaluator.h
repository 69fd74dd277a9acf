#pragma once

#include "optimiser/evaluator.h"
#include "problem/problem.h"

namespace anthrob {
namespace calibration {

/// Evaluates on the threads of this process: points side by side, and the runs of a point too.
class ProblemEvaluator final : public Evaluator {
 public:
  explicit ProblemEvaluator(const Problem& problem) : problem_(problem) {}
  std::vector<double> fitness(const std::vector<Point>& points) override;
  std::vector<std::vector<double>> residuals(const std::vector<Point>& points) override;

 private:
  const Problem& problem_;
};

std::vector<SearchVariable> search_variables(const ParameterSpace& space);

}  // namespace calibration
}  // namespace anthrob
