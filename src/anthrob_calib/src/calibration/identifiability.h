#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "identification/estimate.h"
#include "problem/problem.h"

namespace anthrob {
namespace calibration {

/// What the data say about one parameter near the best point.
struct ParameterKnowledge {
  double sigma = 0.0;        ///< standard error [unit of the parameter]; at most that of its range
  double prior_sigma = 0.0;  ///< standard deviation of its range: range / sqrt(12)
  double freedom = 0.0;      ///< degrees of freedom of sigma, for Student's distribution
  double lower = 0.0, upper = 0.0;  ///< its range
  /// Half of its 95 % interval before that is cut at the range, in 1.96 `prior_sigma`.
  double left = 0.0;
  bool identifiable = false;  ///< `left` is less than kIdentifiableShare
};

/// Fitness along one parameter. The others are moved within bounds to where they compensate best to
/// first order, or are left where they are, whichever fits better. So the fitness is an upper bound
/// of that after a new fit of the others.
struct Profile {
  std::size_t parameter = 0;
  std::vector<double> value, fitness;  ///< fitness is infinite where the model is invalid
};

/// Which parameters the data determine. Computed from the derivatives of all differences at the
/// best point, reduced by limit_derivatives() to what holds for steps as large as the noise allows.
struct Identifiability {
  std::vector<ParameterKnowledge> parameters;
  Eigen::VectorXd singular_values;  ///< of the derivatives in steps, divided by the noise
  std::vector<double> flattest;     ///< least identifiable direction, in steps, length 1
  std::vector<Profile> profiles;    ///< of the least identifiable parameters
  double posture_noise = 0.0;       ///< standard deviation of the remaining differences [rad]
  double force_noise = 0.0;         ///< [N]
  /// The parameters could follow nearly all of the noise of postures or forces, whose size is
  /// hardly known then.
  bool noise_is_doubtful = false;
};

/// A parameter is identifiable if the data leave less than this share of its range's deviation.
constexpr double kIdentifiableShare = 0.3;

/// 95 % interval of a parameter, within its range.
identification::Estimate interval(const Identifiability& known, std::size_t parameter,
                                  double value);

/// @param profiles how many profiles to draw, at most
/// @param before_each called before each simulation of all runs; may throw to end the work
/// @throws BadInput, NumericalFailure if `best` is invalid
Identifiability examine(
    const Problem& problem, const std::vector<double>& best, int profiles,
    const std::function<void()>& before_each = [] {});

/// Equilibria needed by (5.13), whose 3 are the degrees of freedom of its ball joint.
int equilibria_needed(int unknowns, int muscles, int degrees_of_freedom);

}  // namespace calibration
}  // namespace anthrob
