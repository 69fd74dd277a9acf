#include "optimiser/least_squares_optimiser.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "optimiser/descent.h"

namespace anthrob {
namespace calibration {

namespace {

/// Another valley has to be better by more.
constexpr double kBetterValley = 0.02;
constexpr std::size_t kValleys = 4;   ///< that are looked into
constexpr int kJacobiansAValley = 2;  ///< and how far
constexpr double kFar = 0.2;          ///< of a range
constexpr double kFarthest = 10.0;    ///< [steps]
constexpr double kAcrossKinks =
    0.3;  ///< differences of derivatives that see what is beyond [steps]

double square_of(const std::vector<double>& residuals) {
  if (residuals.empty()) return HUGE_VAL;
  return std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
}

/// Else it is the same place for all that residuals tell.
bool differs(const std::vector<double>& residuals, const std::vector<double>& here) {
  double change = 0.0;
  for (std::size_t k = 0; k < here.size(); ++k) change += std::pow(residuals[k] - here[k], 2);
  return change > kBetterValley * square_of(here);
}

/// Where else a way down might begin: far to one side along one variable each, the best first.
std::vector<Point> far_points(const std::vector<SearchVariable>& variables, const Point& point,
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
  std::vector<std::pair<double, Point>> order;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const SearchVariable& v = variables[i];
    // Derivatives may promise that others help where they only spoil it: alone, too.
    const Eigen::VectorXd together = following(information, i),
                          alone = Eigen::VectorXd::Unit(n, static_cast<Eigen::Index>(i));
    const double steps = std::min(kFar * (v.upper - v.lower) / v.step, kFarthest);
    std::vector<Point> far;
    for (const Eigen::VectorXd& direction : {together, alone}) {
      for (const double side : {-1.0, 1.0}) {
        far.push_back(moved(variables, point, direction, side * steps));
      }
    }
    const auto seen = evaluator.residuals(far);
    std::pair<double, Point> best{HUGE_VAL, {}};
    for (std::size_t k = 0; k < far.size(); ++k) {
      const double square = square_of(seen[k]);
      if (square < best.first && differs(seen[k], here)) best = {square, far[k]};
    }
    if (!best.second.empty()) order.push_back(std::move(best));
  }
  std::sort(order.begin(), order.end());
  if (order.size() > kValleys) order.resize(kValleys);
  std::vector<Point> points;
  for (auto& [square, far] : order) points.push_back(std::move(far));
  return points;
}

bool much_better(const Descent& one, const Descent& other) {
  return one.fitness < (1.0 - kBetterValley) * other.fitness;
}

/// Another way down that ends clearly lower; the given one if none is found.
Descent better_valley(const std::vector<SearchVariable>& variables, const Descent& down,
                      Evaluator& evaluator, int& jacobians) {
  const auto begin_at = [&](const Point& point, double difference) {
    int few = std::min(jacobians, kJacobiansAValley);
    jacobians -= few;
    const Descent other = descend(variables, difference, point, evaluator, few);
    jacobians += few;
    return other;
  };
  const Descent across = begin_at(down.point, kAcrossKinks);
  if (much_better(across, down)) return across;
  for (const Point& point : far_points(variables, down.point, evaluator)) {
    const Descent other = begin_at(point, LeastSquaresOptimiser::kDifference);
    if (much_better(other, down)) return other;
  }
  return down;
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
  const auto neighbour = [&](std::size_t i, bool above) {
    const SearchVariable& v = variables[i];
    Point there = point;
    there[i] = above ? std::min(point[i] + difference * v.step, v.upper)
                     : std::max(point[i] - difference * v.step, v.lower);
    return there;
  };
  std::vector<Point> neighbours;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const SearchVariable& v = variables[i];
    // To the side where there is more room, where there is not enough above.
    const bool above =
        point[i] + difference * v.step <= v.upper || v.upper - point[i] >= point[i] - v.lower;
    neighbours.push_back(neighbour(i, above));
  }
  std::vector<std::vector<double>> columns = evaluator.residuals(neighbours);
  const auto valid = [&](std::size_t i) { return columns[i].size() == residuals.size(); };

  // A point that is no valid robot, such as a path pushed into a surface, may have a valid one
  // across.
  std::vector<std::size_t> again;
  std::vector<Point> across;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (valid(i)) continue;
    const Point other = neighbour(i, neighbours[i][i] < point[i]);
    if (other[i] == point[i]) continue;
    again.push_back(i);
    across.push_back(other);
  }
  if (!again.empty()) {
    std::vector<std::vector<double>> others = evaluator.residuals(across);
    for (std::size_t k = 0; k < again.size(); ++k) {
      neighbours[again[k]] = across[k];
      columns[again[k]] = std::move(others[k]);
    }
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!valid(i)) {
      columns[i].assign(residuals.size(), 0.0);
      continue;
    }
    const double steps = (neighbours[i][i] - point[i]) / variables[i].step;
    for (std::size_t k = 0; k < residuals.size(); ++k) {
      columns[i][k] = (columns[i][k] - residuals[k]) / steps;
    }
  }
  return columns;
}

SearchResult LeastSquaresOptimiser::minimise(const std::vector<SearchVariable>& variables,
                                             Evaluator& evaluator) const {
  Point point;
  for (const SearchVariable& v : variables) point.push_back(v.initial);
  int jacobians = settings_.generations;
  Descent down{point, HUGE_VAL, Descent::kMoreToGain};
  std::vector<double> sensitivity(variables.size(), 0.0);
  const auto end = [&](const char* reason) -> SearchResult {
    return {down.point, down.fitness, reason, sensitivity};
  };
  while (true) {
    down = descend(variables, kDifference, down.point, evaluator, jacobians);
    for (std::size_t i = 0; i < down.sensitivity.size(); ++i) {
      sensitivity[i] = std::max(sensitivity[i], down.sensitivity[i]);
    }
    if (down.end == Descent::kInvalidStart) return {point, HUGE_VAL, "the start is not valid"};
    if (down.end == Descent::kStuck) return end("no better point found");
    if (jacobians <= 0) return end("limit of Jacobians reached");
    const Descent other = better_valley(variables, down, evaluator, jacobians);
    if (other.point == down.point)
      return end(jacobians > 0 ? "converged" : "limit of Jacobians reached");
    down = other;
  }
}

}  // namespace calibration
}  // namespace anthrob
