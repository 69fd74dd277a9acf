#include "calibration/identifiability.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "calibration/derivative_limits.h"
#include "calibration/problem_evaluator.h"
#include "optimiser/least_squares_optimiser.h"

namespace anthrob {
namespace calibration {

namespace {

using Kind = DifferenceStack::Kind;

constexpr int kPasses = 2;        ///< over all parameters: a larger error of one may enlarge others
constexpr double kOpened = 1.02;  ///< times the error before: worth checking in another pass

/// A variance made of two that are estimates themselves, each from its rows (Welch-Satterthwaite).
/// @param of_kind parts of the variance   @param repetition rows that count as one
double effective_freedom(const double (&of_kind)[2], const ResidualNoise& noise,
                         const std::array<double, 2>& repetition, double variance) {
  double doubt = 0.0;
  for (const Kind kind : {DifferenceStack::kPosture, DifferenceStack::kForce}) {
    doubt += std::pow(of_kind[kind], 2) * repetition[kind] / std::max(1.0, noise.free[kind]);
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
    // By their derivatives, the others may seem to compensate where in fact they make it worse.
    const std::vector<double> both = stack.fitness({alone, together});
    profile.fitness.push_back(std::min(both[0], both[1]));
  }
  return profile;
}

/// The fit of all parameters, linearised at the best point, and what its noise makes of them.
class LinearFit {
 public:
  LinearFit(const Problem& problem, const Point& best, const std::function<void()>& before_each)
      : variables_(search_variables(problem.space())),
        best_(best),
        stack_(problem, before_each),
        left_(stack_.describe(best)),
        n_(static_cast<Eigen::Index>(best.size())),
        rows_(static_cast<Eigen::Index>(left_.size())) {
    double squares = 0.0;
    Eigen::Index typical = 0;
    list_variance_.resize(rows_);
    for (Eigen::Index k = 0; k < rows_; ++k) {
      const DifferenceStack::Row& row = stack_.rows[static_cast<std::size_t>(k)];
      list_variance_(k) = row.list_variance;
      if (!row.is_typical) continue;
      squares += std::pow(left_[static_cast<std::size_t>(k)], 2);
      ++typical;
    }
    scatter_ =
        std::max(1e-30, squares / static_cast<double>(std::max<Eigen::Index>(1, typical - n_)));
    for (Eigen::Index i = 0; i < n_; ++i) {
      const double prior = (variables_[i].upper - variables_[i].lower) / std::sqrt(12.0);
      known_.push_back(
          {0.0, prior, HUGE_VAL, variables_[i].lower, variables_[i].upper, 0.0, false});
    }
    auto columns =
        derivatives(variables_, best_, left_, LeastSquaresOptimiser::kDifference, stack_);
    take(columns);
    noise_ = ResidualNoise(stack_, left_, gain_.cwiseProduct(jacobian_).rowwise().sum());
    limit_derivatives(variables_, best_, left_, noise_, stack_, columns);
    take(columns);
  }

  /// Standard errors of all parameters. What seems to be identifiable is checked along the line in
  /// which the other parameters compensate for it.
  void find_errors() {
    for (Eigen::Index i = 0; i < n_; ++i) find_error(i);
    Eigen::VectorXd tried =
        Eigen::VectorXd::Zero(n_);  // the error with which a line was last tried
    for (int pass = 0; pass < kPasses; ++pass) {
      for (Eigen::Index i = 0; i < n_; ++i) {
        const ParameterKnowledge& p = known_[i];
        if (!p.identifiable || p.sigma < kOpened * tried[i]) continue;
        tried[i] = p.sigma;
        const bool less =
            limit_derivatives_along(variables_, best_, left_, noise_, stack_,
                                    p.sigma / variables_[i].step, line_of(i), jacobian_);
        if (less) solve();
      }
      for (Eigen::Index i = 0; i < n_; ++i) find_error(i);
    }
  }

  /// Of the least identifiable parameters. @param most number of profiles
  std::vector<Profile> profiles(int most) {
    std::vector<std::size_t> order(best_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return known_[a].left > known_[b].left; });
    std::vector<Profile> profiles;
    for (const std::size_t i : order) {
      if (static_cast<int>(profiles.size()) >= most || known_[i].identifiable) break;
      profiles.push_back(draw_profile(stack_, variables_, best_, information_, i, known_[i].sigma));
    }
    return profiles;
  }

  /// Stores singular values and the least identifiable direction.
  void find_directions(Identifiability& result) const {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(jacobian_.transpose() * jacobian_ /
                                                               scatter_);
    result.singular_values = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().reverse();
    const Eigen::VectorXd flattest = eigen.eigenvectors().col(0);
    result.flattest.assign(flattest.data(), flattest.data() + n_);
  }

  const std::vector<ParameterKnowledge>& known() const { return known_; }
  const ResidualNoise& noise() const { return noise_; }

 private:
  void take(const std::vector<std::vector<double>>& columns) {
    jacobian_.resize(rows_, n_);
    for (Eigen::Index i = 0; i < n_; ++i) {
      jacobian_.col(i) = Eigen::Map<const Eigen::VectorXd>(columns[i].data(), rows_);
    }
    solve();
  }

  void solve() {
    information_ = jacobian_.transpose() * jacobian_;
    // The range of a parameter is knowledge too; without it some would have no error at all. It
    // weighs against the noise of the rows that the parameter changes.
    list_noise_.resize(n_);
    range_information_.resize(n_);
    for (Eigen::Index i = 0; i < n_; ++i) {
      const double told = jacobian_.col(i).squaredNorm();
      const double variance =
          told > 0.0 ? jacobian_.col(i).cwiseAbs2().dot(list_variance_) / told : 1.0;
      list_noise_(i) = scatter_ * variance;
      range_information_(i) =
          list_noise_(i) * std::pow(variables_[i].step / known_[i].prior_sigma, 2);
    }
    information_.diagonal() += range_information_;
    inverse_ = information_.ldlt().solve(Eigen::MatrixXd::Identity(n_, n_));
    gain_ = jacobian_ * inverse_;
  }

  Eigen::VectorXd line_of(Eigen::Index i) const {
    return following(information_, static_cast<std::size_t>(i));
  }

  /// The fit uses the configured weights, not inverse variances of the noise: so the noise is
  /// propagated through the gain of the fit.
  void find_error(Eigen::Index i) {
    double variance = 0.0;
    for (Eigen::Index j = 0; j < n_; ++j) {
      variance += std::pow(inverse_(i, j), 2) * list_noise_(j) * range_information_(j);
    }
    // What an error of a row's difference, as large as a typical one, makes of the parameter.
    const auto gain = [&](Eigen::Index k) {
      return gain_(k, i) * stack_.rows[static_cast<std::size_t>(k)].weight;
    };
    double of_kind[2] = {0.0, 0.0};
    for (Eigen::Index k = 0; k < rows_; ++k) {
      const DifferenceStack::Row& row = stack_.rows[static_cast<std::size_t>(k)];
      const double own = row.deviation * gain(k);
      of_kind[row.kind] += row.repetition * own * own;
      for (const auto& [other, covariance] : row.related) {
        of_kind[row.kind] += 2.0 * covariance * gain(k) * gain(other);
      }
    }
    for (const Kind kind : {DifferenceStack::kPosture, DifferenceStack::kForce}) {
      of_kind[kind] = std::max(0.0, of_kind[kind]) * std::pow(noise_.of(kind), 2);
      variance += of_kind[kind];
    }
    ParameterKnowledge& p = known_[i];
    // Less than the range says is not known, however large the noise.
    p.sigma = std::min(std::sqrt(variance) * variables_[i].step, p.prior_sigma);
    p.freedom = effective_freedom(of_kind, noise_, stack_.repetition, variance);
    const identification::Estimate estimate =
        identification::make_estimate(0.0, p.sigma, p.freedom);
    p.left = estimate.hi / (identification::kNormal95 * p.prior_sigma);
    p.identifiable = p.left < kIdentifiableShare;
  }

  const std::vector<SearchVariable> variables_;
  const Point& best_;
  DifferenceStack stack_;
  const std::vector<double> left_;  ///< the stack's list at the best point
  const Eigen::Index n_, rows_;
  double scatter_ = 0.0;               ///< mean square of the list's typical rows
  Eigen::VectorXd list_variance_;      ///< of each row, in `scatter_`
  Eigen::VectorXd list_noise_;         ///< variance of the list where each parameter changes it
  Eigen::VectorXd range_information_;  ///< what the ranges say, in the units of `information_`
  /// Of the weighted list, by steps of the search.
  Eigen::MatrixXd jacobian_, information_, inverse_, gain_;
  ResidualNoise noise_;
  std::vector<ParameterKnowledge> known_;
};

}  // namespace

Identifiability examine(const Problem& problem, const std::vector<double>& best, int profiles,
                        const std::function<void()>& before_each) {
  LinearFit fit(problem, best, before_each);
  fit.find_errors();
  Identifiability result;
  result.parameters = fit.known();
  result.posture_noise = fit.noise().posture;
  result.force_noise = fit.noise().force;
  result.noise_is_doubtful = fit.noise().absorbed[0] || fit.noise().absorbed[1];
  fit.find_directions(result);
  result.profiles = fit.profiles(profiles);
  return result;
}

identification::Estimate interval(const Identifiability& known, std::size_t parameter,
                                  double value) {
  const ParameterKnowledge& p = known.parameters[parameter];
  identification::Estimate estimate = identification::make_estimate(value, p.sigma, p.freedom);
  estimate.lo = std::max(estimate.lo, std::min(p.lower, value));
  estimate.hi = std::min(estimate.hi, std::max(p.upper, value));
  return estimate;
}

int equilibria_needed(int unknowns, int muscles, int degrees_of_freedom) {
  const int missing = std::max(0, unknowns - muscles);
  const int equations = std::max(1, degrees_of_freedom);  // a rig may have no joint that moves
  return std::max(1, (missing + equations - 1) / equations);
}

}  // namespace calibration
}  // namespace anthrob
