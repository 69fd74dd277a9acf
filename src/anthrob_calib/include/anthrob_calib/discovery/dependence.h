#pragma once

#include <string>
#include <vector>

#include "anthrob_calib/discovery/measured_variable.h"
#include "anthrob_calib/discovery/noise_floor.h"

namespace anthrob {
namespace discovery {

/// On what the disagreement in one channel depends: the measured quantity that predicts it best,
/// and how.
struct Dependence {
  static constexpr double kTelling = 0.05;  ///< share that says something

  std::string channel;   ///< "<place>/<quantity>", components of an orientation named x, y, z
  std::string variable;  ///< "biceps_brachii/force"; empty if nothing predicts it
  std::string word;      ///< "sign of velocity", "load", "posture", "time", ...
  /// Of its square, what the curve predicts in data it was not fitted to, beyond what a constant
  /// does, which depends on nothing.
  double share = 0.0;
  double constant = 0.0;                 ///< of its square, what a constant predicts there
  std::vector<double> at, curve, error;  ///< variable and residual [their units], standard error
};

/// Tries every measured quantity of the same place, every joint, and time, with a curve of a few
/// steps fitted on one half of the blocks and judged on the other.
/// @param residual in units of sigma, as whitened by `whitener`
std::vector<Dependence> find_dependences(const Experiments& experiments,
                                         const std::vector<MeasuredVariable>& variables,
                                         const Eigen::VectorXf& residual,
                                         const Eigen::VectorXf& whitener);

}  // namespace discovery
}  // namespace anthrob
