#include "anthrob_calib/optimiser/least_squares_optimiser.h"

#include <ceres/ceres.h>

#include <cmath>

namespace anthrob {
namespace calibration {

namespace {

/// A smaller share of the fitness is not worth another Jacobian.
constexpr double kWorthwhile = 1e-4;

Point unscaled(const std::vector<SearchVariable>& variables, const double* z) {
  Point point;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const SearchVariable& v = variables[i];
    point.push_back(std::min(std::max(v.initial + z[i] * v.step, v.lower), v.upper));
  }
  return point;
}

/// Residuals as a function of the variables in steps from their start.
class Cost final : public ceres::CostFunction {
 public:
  Cost(const std::vector<SearchVariable>& variables, std::size_t residuals, Evaluator& evaluator)
      : variables_(variables), evaluator_(evaluator) {
    set_num_residuals(static_cast<int>(residuals));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(variables.size()));
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const Point point = unscaled(variables_, parameters[0]);
    const std::vector<double> r = evaluator_.residuals({point}).front();
    if (r.empty()) return false;  // an invalid point: Ceres goes back
    std::copy(r.begin(), r.end(), residuals);
    if (!jacobians || !jacobians[0]) return true;
    const auto columns =
        derivatives(variables_, point, r, LeastSquaresOptimiser::kDifference, evaluator_);
    for (std::size_t k = 0; k < r.size(); ++k) {
      for (std::size_t i = 0; i < columns.size(); ++i) {
        jacobians[0][k * columns.size() + i] = columns[i][k];
      }
    }
    return true;
  }

 private:
  const std::vector<SearchVariable>& variables_;
  Evaluator& evaluator_;
};

}  // namespace

std::vector<std::vector<double>> derivatives(const std::vector<SearchVariable>& variables,
                                             const Point& point,
                                             const std::vector<double>& residuals,
                                             double difference, Evaluator& evaluator) {
  std::vector<Point> neighbours;
  std::vector<double> moved;  // [steps]
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const SearchVariable& v = variables[i];
    const double up = point[i] + difference * v.step;
    const double sign = up <= v.upper ? 1.0 : -1.0;
    neighbours.push_back(point);
    neighbours.back()[i] = point[i] + sign * difference * v.step;
    moved.push_back((neighbours.back()[i] - point[i]) / v.step);
  }
  std::vector<std::vector<double>> columns = evaluator.residuals(neighbours);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const bool valid = columns[i].size() == residuals.size();
    if (!valid) columns[i].assign(residuals.size(), 0.0);
    for (std::size_t k = 0; valid && k < residuals.size(); ++k) {
      columns[i][k] = (columns[i][k] - residuals[k]) / moved[i];
    }
  }
  return columns;
}

SearchResult LeastSquaresOptimiser::minimise(const std::vector<SearchVariable>& variables,
                                             Evaluator& evaluator) const {
  std::vector<double> z(variables.size(), 0.0);
  const std::vector<double> start = evaluator.residuals({unscaled(variables, z.data())}).front();
  if (start.empty()) return {unscaled(variables, z.data()), HUGE_VAL, "the start is invalid"};
  ceres::Problem problem;
  problem.AddResidualBlock(new Cost(variables, start.size(), evaluator), nullptr, z.data());
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const SearchVariable& v = variables[i];
    problem.SetParameterLowerBound(z.data(), static_cast<int>(i), (v.lower - v.initial) / v.step);
    problem.SetParameterUpperBound(z.data(), static_cast<int>(i), (v.upper - v.initial) / v.step);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = settings_.generations;
  options.function_tolerance = kWorthwhile;
  options.parameter_tolerance = 1e-4;
  options.initial_trust_region_radius = 1e2;
  // Between bounds Ceres also searches along the step; the default would ask for a Jacobian at each
  // trial point.
  options.line_search_interpolation_type = ceres::QUADRATIC;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  const char* reason = summary.termination_type == ceres::CONVERGENCE ? "converged"
                       : summary.termination_type == ceres::NO_CONVERGENCE
                           ? "all iterations done"
                           : "no better point found";
  return {unscaled(variables, z.data()), 2.0 * summary.final_cost, reason};
}

}  // namespace calibration
}  // namespace anthrob
