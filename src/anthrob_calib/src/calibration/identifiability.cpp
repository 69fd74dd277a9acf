#include "anthrob_calib/calibration/identifiability.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "anthrob_calib/calibration/caution.h"
#include "anthrob_calib/optimiser/least_squares_optimiser.h"
#include "anthrob_calib/optimiser/problem_evaluator.h"

namespace anthrob {
namespace calibration {

namespace {

using Kind = DifferenceStack::Kind;

constexpr int kPasses = 2;        ///< over all parameters: what one opens opens others
constexpr double kOpened = 1.02;  ///< times the error before: worth a look in another pass

/// A variance made of two that are estimates themselves, each from its rows (Welch-Satterthwaite).
double effective_freedom(const double (&of_kind)[2], const ResidualNoise& noise, double repetition,
                         double variance) {
  double doubt = 0.0;
  for (const Kind kind : {DifferenceStack::kPosture, DifferenceStack::kForce}) {
    doubt += std::pow(repetition * of_kind[kind], 2) * repetition / std::max(1.0, noise.free[kind]);
  }
  return doubt > 0.0 ? std::max(1.0, variance * variance / doubt) : HUGE_VAL;
}

Profile draw_profile(DifferenceStack& stack, const std::vector<SearchVariable>& variables,
                     const Point& best, const Eigen::MatrixXd& information, std::size_t index,
                     double sigma) {
  const Eigen::VectorXd direction = following(information, index);
  Profile profile;
  profile.parameter = index;
  for (const double share : {-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5}) {
    const Point together = moved(variables, best, direction, share * sigma / variables[index].step);
    Point alone = best;
    alone[index] = together[index];
    if (!profile.value.empty() && alone[index] == profile.value.back()) continue;  // at a bound
    profile.value.push_back(alone[index]);
    // Derivatives may promise that others can help where they only spoil it.
    const std::vector<double> both = stack.fitness({alone, together});
    profile.fitness.push_back(std::min(both[0], both[1]));
  }
  return profile;
}

}  // namespace

Identifiability examine(const Problem& problem, const std::vector<double>& best, int profiles,
                        const std::function<void()>& before_each) {
  Identifiability result;
  const std::vector<SearchVariable> variables = search_variables(problem.space());
  DifferenceStack stack(problem, before_each);
  const std::vector<double> left = stack.describe(best);
  auto columns = derivatives(variables, best, left, LeastSquaresOptimiser::kDifference, stack);
  const auto n = static_cast<Eigen::Index>(best.size());
  const auto rows = static_cast<Eigen::Index>(left.size());
  const double scatter =
      std::max(1e-30, Eigen::Map<const Eigen::VectorXd>(left.data(), rows).squaredNorm() /
                          static_cast<double>(std::max<Eigen::Index>(1, rows - n)));
  // The range of a parameter is knowledge too; without it some would have no error at all.
  Eigen::VectorXd range_information(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double prior = (variables[i].upper - variables[i].lower) / std::sqrt(12.0);
    result.parameters.push_back({0.0, prior, HUGE_VAL, false});
    range_information(i) = scatter * stack.repetition * std::pow(variables[i].step / prior, 2);
  }
  Eigen::MatrixXd jacobian(rows, n), information, inverse, gain;  // of the weighted list, by steps
  const auto linearise = [&] {
    information = jacobian.transpose() * jacobian;
    information.diagonal() += range_information;
    inverse = information.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
    gain = jacobian * inverse;
  };
  const auto fill = [&] {
    for (Eigen::Index i = 0; i < n; ++i) {
      jacobian.col(i) = Eigen::Map<const Eigen::VectorXd>(columns[i].data(), rows);
    }
    linearise();
  };
  fill();
  const ResidualNoise noise(stack, left, gain.cwiseProduct(jacobian).rowwise().sum());
  result.posture_noise = noise.posture;
  result.force_noise = noise.force;
  be_cautious(variables, best, left, noise, stack, columns);
  fill();

  // The fit weighs as it is told to, not as noise would have it: errors go through its gain.
  const auto work_out = [&](Eigen::Index i) {
    const double prior =
        scatter * stack.repetition * inverse.row(i).cwiseAbs2().dot(range_information.transpose());
    double of_kind[2] = {0.0, 0.0};
    for (Eigen::Index k = 0; k < rows; ++k) {
      const Kind kind = stack.kind[k];
      of_kind[kind] += std::pow(gain(k, i) * stack.weight[k] * noise.of(kind), 2);
    }
    ParameterKnowledge& p = result.parameters[i];
    const double variance =
        stack.repetition * (of_kind[DifferenceStack::kPosture] + of_kind[DifferenceStack::kForce]) +
        prior;
    p.sigma = std::sqrt(std::max(0.0, variance)) * variables[i].step;
    p.identifiable = p.sigma < kIdentifiableShare * p.prior_sigma;
    p.freedom = effective_freedom(of_kind, noise, stack.repetition, variance);
  };
  for (Eigen::Index i = 0; i < n; ++i) work_out(i);
  Eigen::VectorXd tried = Eigen::VectorXd::Zero(n);  // the error with which a line was last tried
  for (int pass = 0; pass < kPasses; ++pass) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const ParameterKnowledge& p = result.parameters[i];
      if (!p.identifiable || p.sigma < kOpened * tried[i]) continue;
      tried[i] = p.sigma;
      const bool less =
          be_cautious_along(variables, best, left, noise, stack, p.sigma / variables[i].step,
                            following(information, static_cast<std::size_t>(i)), jacobian);
      if (less) linearise();
    }
    for (Eigen::Index i = 0; i < n; ++i) work_out(i);
  }

  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(jacobian.transpose() * jacobian /
                                                             scatter);
  result.singular_values = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().reverse();
  const Eigen::VectorXd flattest = eigen.eigenvectors().col(0);
  result.flattest.assign(flattest.data(), flattest.data() + n);

  std::vector<std::size_t> order(best.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto doubt = [&](std::size_t i) {
    return result.parameters[i].sigma / result.parameters[i].prior_sigma;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return doubt(a) > doubt(b); });
  for (const std::size_t i : order) {
    if (static_cast<int>(result.profiles.size()) >= profiles) break;
    if (result.parameters[i].identifiable) break;
    result.profiles.push_back(
        draw_profile(stack, variables, best, information, i, result.parameters[i].sigma));
  }
  return result;
}

identification::Estimate interval(const Identifiability& known, std::size_t parameter,
                                  double value) {
  const ParameterKnowledge& p = known.parameters[parameter];
  return identification::make_estimate(value, p.sigma, p.freedom);
}

int equilibria_needed(int unknowns, int muscles) {
  return std::max(1, (unknowns - muscles + 2) / 3);
}

}  // namespace calibration
}  // namespace anthrob
