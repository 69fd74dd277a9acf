#include "anthrob_calib/optimiser/least_squares_optimiser.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numeric>

namespace anthrob {
namespace calibration {

namespace {

/// A smaller share of the fitness is not worth another Jacobian.
constexpr double kWorthwhile = 1e-4;
/// Another valley has to be better by more.
constexpr double kBetterValley = 0.02;
constexpr double kFar = 0.2;        ///< of a range
constexpr double kFarthest = 10.0;  ///< [steps]
constexpr double kAcrossKinks =
    0.3;  ///< differences of derivatives that see what is beyond [steps]

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
  Cost(const std::vector<SearchVariable>& variables, std::size_t residuals, double difference,
       Evaluator& evaluator)
      : variables_(variables), difference_(difference), evaluator_(evaluator) {
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
    const auto columns = derivatives(variables_, point, r, difference_, evaluator_);
    for (std::size_t k = 0; k < r.size(); ++k) {
      for (std::size_t i = 0; i < columns.size(); ++i) {
        jacobians[0][k * columns.size() + i] = columns[i][k];
      }
    }
    return true;
  }

 private:
  const std::vector<SearchVariable>& variables_;
  double difference_;  ///< of derivatives [steps]
  Evaluator& evaluator_;
};

double square_of(const std::vector<double>& residuals) {
  if (residuals.empty()) return HUGE_VAL;
  return std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
}

/// The best of what can be seen far along each variable; the given point if nothing is better.
Point better_valley(const std::vector<SearchVariable>& variables, const Point& point,
                    Evaluator& evaluator) {
  const std::vector<double> here = evaluator.residuals({point}).front();
  const auto columns =
      derivatives(variables, point, here, LeastSquaresOptimiser::kDifference, evaluator);
  const auto n = static_cast<Eigen::Index>(variables.size());
  Eigen::MatrixXd jacobian(static_cast<Eigen::Index>(here.size()), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    jacobian.col(i) = Eigen::Map<const Eigen::VectorXd>(columns[i].data(), jacobian.rows());
  }
  // Its range is what is known of a variable that residuals do not tell.
  const double scatter = square_of(here) / static_cast<double>(here.size());
  Eigen::MatrixXd information = jacobian.transpose() * jacobian;
  for (Eigen::Index i = 0; i < n; ++i) {
    const SearchVariable& v = variables[i];
    information(i, i) += 12.0 * scatter * std::pow(v.step / (v.upper - v.lower), 2) + 1e-300;
  }
  std::vector<Point> far;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const SearchVariable& v = variables[i];
    // Derivatives may promise that others help where they only spoil it: alone, too.
    const Eigen::VectorXd together = following(information, i),
                          alone = Eigen::VectorXd::Unit(n, static_cast<Eigen::Index>(i));
    const double steps = std::min(kFar * (v.upper - v.lower) / v.step, kFarthest);
    for (const Eigen::VectorXd& direction : {together, alone}) {
      for (const double side : {-1.0, 1.0}) {
        far.push_back(moved(variables, point, direction, side * steps));
      }
    }
  }
  const auto seen = evaluator.residuals(far);
  double least = (1.0 - kBetterValley) * square_of(here);
  Point best = point;
  for (std::size_t k = 0; k < far.size(); ++k) {
    const double square = square_of(seen[k]);
    if (square >= least) continue;
    least = square;
    best = far[k];
  }
  return best;
}

}  // namespace

Eigen::VectorXd following(const Eigen::MatrixXd& information, std::size_t variable) {
  // Minus (A_oo)^-1 A_oi.
  const auto i = static_cast<Eigen::Index>(variable);
  Eigen::MatrixXd others = information;
  others.row(i).setZero();
  others.col(i).setZero();
  others(i, i) = 1.0;
  Eigen::VectorXd coupling = information.col(i);
  coupling(i) = -1.0;
  return -others.ldlt().solve(coupling);
}

Point moved(const std::vector<SearchVariable>& variables, const Point& from,
            const Eigen::VectorXd& direction, double steps) {
  Point point = from;
  for (std::size_t k = 0; k < point.size(); ++k) {
    const SearchVariable& v = variables[k];
    const double change = steps * direction(static_cast<Eigen::Index>(k)) * v.step;
    point[k] = std::clamp(from[k] + change, v.lower, v.upper);
  }
  return point;
}

std::vector<std::vector<double>> derivatives(const std::vector<SearchVariable>& variables,
                                             const Point& point,
                                             const std::vector<double>& residuals,
                                             double difference, Evaluator& evaluator) {
  std::vector<Point> neighbours;
  std::vector<double> steps;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const SearchVariable& v = variables[i];
    const double up = point[i] + difference * v.step;
    const double sign = up <= v.upper ? 1.0 : -1.0;
    neighbours.push_back(point);
    neighbours.back()[i] = point[i] + sign * difference * v.step;
    steps.push_back((neighbours.back()[i] - point[i]) / v.step);
  }
  std::vector<std::vector<double>> columns = evaluator.residuals(neighbours);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const bool valid = columns[i].size() == residuals.size();
    if (!valid) columns[i].assign(residuals.size(), 0.0);
    for (std::size_t k = 0; valid && k < residuals.size(); ++k) {
      columns[i][k] = (columns[i][k] - residuals[k]) / steps[i];
    }
  }
  return columns;
}

namespace {

/// One descent; takes what it needs of the iterations.
ceres::TerminationType descend(const std::vector<SearchVariable>& variables, double difference,
                               std::size_t residuals, Evaluator& evaluator, int& iterations,
                               Point& point, double& fitness) {
  Cost cost(variables, residuals, difference, evaluator);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  std::vector<double> z;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    z.push_back((point[i] - variables[i].initial) / variables[i].step);
  }
  problem.AddResidualBlock(&cost, nullptr, z.data());
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const SearchVariable& v = variables[i];
    problem.SetParameterLowerBound(z.data(), static_cast<int>(i), (v.lower - v.initial) / v.step);
    problem.SetParameterUpperBound(z.data(), static_cast<int>(i), (v.upper - v.initial) / v.step);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = iterations;
  options.function_tolerance = kWorthwhile;
  options.parameter_tolerance = 1e-4;
  options.initial_trust_region_radius = 1e2;
  // Between bounds Ceres also searches along the step; the default would ask for a Jacobian at each
  // trial point.
  options.line_search_interpolation_type = ceres::QUADRATIC;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  iterations -= std::max(1, summary.num_successful_steps + summary.num_unsuccessful_steps - 1);
  point = unscaled(variables, z.data());
  fitness = 2.0 * summary.final_cost;
  return summary.termination_type;
}

}  // namespace

SearchResult LeastSquaresOptimiser::minimise(const std::vector<SearchVariable>& variables,
                                             Evaluator& evaluator) const {
  Point point;
  for (const SearchVariable& v : variables) point.push_back(v.initial);
  const std::size_t residuals = evaluator.residuals({point}).front().size();
  if (residuals == 0) return {point, HUGE_VAL, "the start is invalid"};
  int iterations = settings_.generations;
  double fitness = HUGE_VAL;
  while (true) {
    const auto end =
        descend(variables, kDifference, residuals, evaluator, iterations, point, fitness);
    if (end == ceres::NO_CONVERGENCE || iterations <= 0) {
      return {point, fitness, "all iterations done"};
    }
    if (end != ceres::CONVERGENCE) return {point, fitness, "no better point found"};
    Point other = better_valley(variables, point, evaluator);
    if (other == point) {
      double seen = fitness;
      descend(variables, kAcrossKinks, residuals, evaluator, iterations, other, seen);
      if (seen > (1.0 - kBetterValley) * fitness) return {point, fitness, "converged"};
      if (iterations <= 0) return {other, seen, "all iterations done"};
    }
    point = std::move(other);
  }
}

}  // namespace calibration
}  // namespace anthrob
