#pragma once

#include <string>
#include <vector>

#include "anthrob_calib/discovery/experiment/measured_variable.h"
#include "anthrob_calib/discovery/experiment/noise_floor.h"

namespace anthrob {
namespace discovery {

/// What the residual of one channel depends on: the measured quantity that predicts it best, and
/// the curve.
struct Dependence {
  static constexpr double kTelling = 0.05;  ///< a smaller share says nothing

  std::string channel;   ///< "<place>/<quantity>", components of an orientation named x, y, z
  std::string variable;  ///< "biceps_brachii/force"; empty if nothing predicts it
  std::string unit, variable_unit;  ///< of both; empty: not known
  std::string word;                 ///< "sign of velocity", "load", "posture", "time", ...
  /// Share of the squared residual that the curve predicts in blocks to which it was not fitted, in
  /// addition to what a constant predicts.
  double share = 0.0;
  double constant = 0.0;  ///< share of the squared residual that a constant predicts there
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
