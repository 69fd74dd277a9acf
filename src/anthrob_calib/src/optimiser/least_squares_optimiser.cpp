#include "anthrob_calib/optimiser/least_squares_optimiser.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numeric>

#include "anthrob_calib/optimiser/descent.h"

namespace anthrob {
namespace calibration {

namespace {

/// Another valley has to be better by more.
constexpr double kBetterValley = 0.02;
constexpr double kFar = 0.2;        ///< of a range
constexpr double kFarthest = 10.0;  ///< [steps]
constexpr double kAcrossKinks =
    0.3;  ///< differences of derivatives that see what is beyond [steps]

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

SearchResult LeastSquaresOptimiser::minimise(const std::vector<SearchVariable>& variables,
                                             Evaluator& evaluator) const {
  Point point;
  for (const SearchVariable& v : variables) point.push_back(v.initial);
  const std::size_t residuals = evaluator.residuals({point}).front().size();
  if (residuals == 0) return {point, HUGE_VAL, "the start is invalid"};
  int jacobians = settings_.generations;
  Descent down{point, HUGE_VAL, Descent::kMoreToGain};
  while (true) {
    down = descend(variables, kDifference, down.point, evaluator, jacobians);
    if (down.end == Descent::kMoreToGain) return {down.point, down.fitness, "all iterations done"};
    if (down.end == Descent::kStuck) return {down.point, down.fitness, "no better point found"};
    Point other = better_valley(variables, down.point, evaluator);
    if (other == down.point) {
      const Descent across = descend(variables, kAcrossKinks, other, evaluator, jacobians);
      if (across.fitness > (1.0 - kBetterValley) * down.fitness) {
        return {down.point, down.fitness, "converged"};
      }
      other = across.point;
    }
    if (jacobians <= 0)
      return {other, square_of(evaluator.residuals({other}).front()), "all iterations done"};
    down.point = std::move(other);
  }
}

}  // namespace calibration
}  // namespace anthrob
