#include "calibration/derivative_limits.h"

#include <algorithm>
#include <cmath>

#include "optimiser/least_squares_optimiser.h"

namespace anthrob {
namespace calibration {

namespace {

// These numbers were chosen; none of them comes from a source. They only have to be of the right
// order: the examples in identifiability_test.cpp (a tendon that is just taut) and the coverage
// in recovery_test.cpp are what they have to satisfy.

/// What a first trial should change by its derivatives, in standard deviations of the noise: so
/// much more than noise that it cannot hide a fading derivative, so little that it stays near what
/// the noise leaves open.
constexpr double kFirst = 6.0;
/// Each further trial goes that much farther, up to so many trials: 64 times the first one. A
/// tendon that hangs through by more would have to be found by the search.
constexpr double kGrowth = 4.0;
constexpr int kTrials = 4;
/// Standard deviations of all data together: what changes more is ruled out by them, and where a
/// trial goes beyond the first one it tells nothing of what they leave open. Twice the first
/// trial, so that one instant alone does not end the trials.
constexpr double kExcluded = 12.0;
/// A change of less than this share of the predicted one is a reason to look farther away. The rest
/// is left to the curvature of a smooth model, which is no such reason.
constexpr double kLess = 0.7;
/// A change of less than this share replaces the derivative: then it stems from another state of
/// the robot (a tendon taut or slack) rather than from curvature.
constexpr double kMuchLess = 0.5;
/// Of several parameters that move together, those are to blame for a missing change whose part of
/// the predicted one is at least this share of the largest part.
constexpr double kBehind = 0.1;
/// Standard deviations of the noise by which an instant should have changed, so that a missing
/// change counts: what the noise would cover anyway is left alone.
constexpr double kFelt = 2.0;

/// Change of one number of the list in its noise.
template <class List>
double in_noise(const List& change, std::size_t k, const DifferenceStack& stack,
                const ResidualNoise& noise) {
  const DifferenceStack::Row& row = stack.rows[k];
  return row.weight > 0.0 ? change[k] / (row.weight * noise.of(row)) : 0.0;
}

/// Lengths of a change of the list in each instant, noise at 1.
template <class List>
Eigen::ArrayXd lengths(const List& change, const DifferenceStack& stack,
                       const ResidualNoise& noise) {
  Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(stack.instants);
  for (std::size_t k = 0; k < stack.rows.size(); ++k) {
    squares[stack.rows[k].instant] += std::pow(in_noise(change, k, stack, noise), 2);
  }
  return squares.sqrt();
}

/// Whether all data together rule out a change of the list.
template <class List>
bool ruled_out(const List& change, const DifferenceStack& stack, const ResidualNoise& noise) {
  double square = 0.0;
  for (std::size_t k = 0; k < stack.rows.size(); ++k) {
    square += std::pow(in_noise(change, k, stack, noise), 2) / stack.rows[k].repetition;
  }
  return square > kExcluded * kExcluded;
}

}  // namespace

void limit_derivatives(const std::vector<SearchVariable>& variables, const Point& best,
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
        for (std::size_t k = 0; k < change.size(); ++k) change[k] -= left[k];
        const bool excluded = ruled_out(change, stack, noise);
        for (double& x : change) x /= steps;
        const Eigen::ArrayXd kept = lengths(change, stack, noise);
        if (trial > 0 && excluded) break;
        for (std::size_t k = 0; k < change.size(); ++k) {
          const int instant = stack.rows[k].instant;
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

bool limit_derivatives_along(const std::vector<SearchVariable>& variables, const Point& best,
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
      const bool excluded = ruled_out(change, stack, noise);
      if (trial > 0 && excluded) break;
      for (Eigen::Index k = 0; k < jacobian.rows(); ++k) {
        const int instant = stack.rows[static_cast<std::size_t>(k)].instant;
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
