#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "anthrob_calib/calibration/problem.h"
#include "anthrob_calib/identification/estimate.h"

namespace anthrob {
namespace calibration {

/// What the data say about one parameter, near the best point.
struct ParameterKnowledge {
  double sigma = 0.0;        ///< standard error [unit of the parameter]; at most that of its range
  double prior_sigma = 0.0;  ///< what its range alone says: range / sqrt(12)
  double freedom = 0.0;      ///< of sigma, for Student's distribution: few rows may be behind it
  bool identifiable = false;
};

/// Fitness along one parameter, the others put where they do best to first order within bounds, or
/// left where they are, whichever fits better: no more than an upper bound of the best.
struct Profile {
  std::size_t parameter = 0;
  std::vector<double> value, fitness;  ///< fitness is infinite where the model is invalid
};

/// Which parameters the data can tell: from the derivatives of all differences at the best point,
/// as far as these hold for steps that noise leaves open.
struct Identifiability {
  std::vector<ParameterKnowledge> parameters;
  Eigen::VectorXd singular_values;  ///< of the derivatives by steps, noise at 1
  std::vector<double> flattest;     ///< direction the data tell least, in steps, length 1
  std::vector<Profile> profiles;    ///< of the least identifiable parameters
  double posture_noise = 0.0;       ///< standard deviation of what is left [rad]
  double force_noise = 0.0;         ///< [N]
};

/// A parameter is identifiable if the data leave less than this share of its range's deviation.
constexpr double kIdentifiableShare = 0.3;

/// 95 % interval of a parameter.
identification::Estimate interval(const Identifiability& known, std::size_t parameter,
                                  double value);

/// @param profiles how many profiles to draw, at most
/// @param before_each called before each simulation of all runs; may throw to end the work
/// @throws BadInput, NumericalFailure if `best` is invalid
Identifiability examine(
    const Problem& problem, const std::vector<double>& best, int profiles,
    const std::function<void()>& before_each = [] {});

/// Equilibria needed by (5.13).
int equilibria_needed(int unknowns, int muscles);

}  // namespace calibration
}  // namespace anthrob
