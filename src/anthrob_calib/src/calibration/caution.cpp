#include "anthrob_calib/calibration/caution.h"

#include <algorithm>
#include <cmath>

#include "anthrob_calib/optimiser/least_squares_optimiser.h"

namespace anthrob {
namespace calibration {

namespace {

constexpr double kFirst = 6.0;  ///< standard deviations of noise: what a first trial should change
constexpr double kGrowth = 4.0;
/// Standard deviations of all data together: what changes more is ruled out by them, and where a
/// trial goes beyond the first one it tells nothing of what they leave open.
constexpr double kExcluded = 12.0;
constexpr int kTrials = 4;
constexpr double kLess = 0.7, kMuchLess = 0.5;
constexpr double kBehind = 0.1;  ///< of the largest share of a promise
constexpr double kFelt = 2.0;    ///< standard deviations of noise that an instant should have moved

/// Lengths of a change of the list in each instant, noise at 1.
template <class List>
Eigen::ArrayXd lengths(const List& change, const DifferenceStack& stack,
                       const ResidualNoise& noise) {
  Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(stack.instants);
  for (std::size_t k = 0; k < stack.kind.size(); ++k) {
    if (!(stack.weight[k] > 0.0)) continue;
    squares[stack.instant[k]] +=
        std::pow(change[k] / (stack.weight[k] * noise.of(stack.kind[k])), 2);
  }
  return squares.sqrt();
}

/// @param moved lengths of a change in each instant
bool ruled_out(const Eigen::ArrayXd& moved, const DifferenceStack& stack) {
  return moved.matrix().norm() > kExcluded * std::sqrt(stack.repetition);
}

}  // namespace

void be_cautious(const std::vector<SearchVariable>& variables, const Point& best,
                 const std::vector<double>& left, const ResidualNoise& noise,
                 DifferenceStack& stack, std::vector<std::vector<double>>& columns) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const SearchVariable& v = variables[i];
    const std::vector<double> local = columns[i];
    const Eigen::ArrayXd promised = lengths(local, stack, noise);
    if (!(promised.maxCoeff() > 0.0)) continue;
    Eigen::ArrayXd least = promised;
    for (const double side : {-1.0, 1.0}) {
      double reach = kFirst / promised.maxCoeff();  // [steps]
      for (int trial = 0; trial < kTrials; ++trial, reach *= kGrowth) {
        Point point = best;
        point[i] = std::clamp(best[i] + side * reach * v.step, v.lower, v.upper);
        const double steps = (point[i] - best[i]) / v.step;
        if (std::abs(steps) < 1e-3 * reach) break;  // at a bound
        std::vector<double> change = stack.residuals({point}).front();
        if (change.empty()) break;  // no such robot
        for (std::size_t k = 0; k < change.size(); ++k) change[k] = (change[k] - left[k]) / steps;
        const Eigen::ArrayXd kept = lengths(change, stack, noise);
        const bool excluded = ruled_out(kept * std::abs(steps), stack);
        if (trial > 0 && excluded) break;
        for (std::size_t k = 0; k < change.size(); ++k) {
          const int instant = stack.instant[k];
          if (kept[instant] < std::min(kMuchLess * promised[instant], least[instant])) {
            columns[i][k] = change[k];
          }
        }
        least = (kept < kMuchLess * promised).select(least.min(kept), least);
        const bool faded = (kept < kLess * promised && promised * std::abs(steps) > kFelt).any();
        if (!faded || excluded || std::abs(steps) < 0.99 * reach) break;
      }
    }
  }
}

bool be_cautious_along(const std::vector<SearchVariable>& variables, const Point& best,
                       const std::vector<double>& left, const ResidualNoise& noise,
                       DifferenceStack& stack, double sigma, const Eigen::VectorXd& direction,
                       Eigen::MatrixXd& jacobian) {
  bool less = false;
  const auto here = Eigen::Map<const Eigen::VectorXd>(left.data(), jacobian.rows());
  for (const double side : {-1.0, 1.0}) {
    double reach = kFirst * sigma;
    for (int trial = 0; trial < kTrials; ++trial, reach *= kGrowth) {
      const Point point = moved(variables, best, direction, side * reach);
      Eigen::VectorXd step(direction.size());
      for (Eigen::Index i = 0; i < step.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        step[i] = (point[k] - best[k]) / variables[k].step;
      }
      const std::vector<double> list = stack.residuals({point}).front();
      if (list.empty() || !(step.squaredNorm() > 0.0)) break;
      const Eigen::VectorXd change =
          Eigen::Map<const Eigen::VectorXd>(list.data(), jacobian.rows()) - here;
      const Eigen::VectorXd promise = jacobian * step;
      const Eigen::ArrayXd kept = lengths(change, stack, noise),
                           promised = lengths(promise, stack, noise);
      const bool excluded = ruled_out(kept, stack);
      if (trial > 0 && excluded) break;
      for (Eigen::Index k = 0; k < jacobian.rows(); ++k) {
        const int instant = stack.instant[static_cast<std::size_t>(k)];
        if (promised[instant] < kFelt || kept[instant] > kMuchLess * promised[instant]) continue;
        // Only taken away, and from those that are behind the promise: nothing is learned here.
        const Eigen::RowVectorXd parts = jacobian.row(k).cwiseProduct(step.transpose());
        const double least = kBehind * parts.cwiseAbs().maxCoeff();
        for (Eigen::Index i = 0; i < parts.size(); ++i) {
          if (std::abs(parts[i]) < least) continue;
          jacobian(k, i) *= kept[instant] / promised[instant];
          less = true;
        }
      }
      const bool faded = (kept < kLess * promised && promised > kFelt).any();
      if (!faded || excluded || std::abs(step.norm()) < 0.5 * reach * direction.norm()) break;
    }
  }
  return less;
}

}  // namespace calibration
}  // namespace anthrob
